#include "tools/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace phare {

std::string ProcessEnd::text() const {
  if (signal == 0) return "exit " + std::to_string(exit_code);
  const char* name = sigabbrev_np(signal);
  return name != nullptr ? std::string("SIG") + name : "signal " + std::to_string(signal);
}

Result<ChildProcess> ChildProcess::start(const std::filesystem::path& program,
                                         const std::vector<std::string>& arguments) {
  // Everything that allocates comes before fork; between fork and exec only async-signal-safe calls are made.
  const std::string path = program.string();
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int failure_pipe[2];
  if (pipe2(failure_pipe, O_CLOEXEC) != 0) return Error{path, std::string("pipe: ") + std::strerror(errno)};

  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) {
    const int failed = errno;
    close(failure_pipe[0]);
    close(failure_pipe[1]);
    return Error{path, std::string("fork: ") + std::strerror(failed)};
  }
  if (pid == 0) {
    // It stays in our process group: keys of the terminal reach the cockpit, Ctrl-C reaches all.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    execv(path.c_str(), argv.data());
    const int failed = errno;
    [[maybe_unused]] const ssize_t written = write(failure_pipe[1], &failed, sizeof failed);
    _exit(127);
  }
  close(failure_pipe[1]);
  int failed = 0;
  const ssize_t got = read(failure_pipe[0], &failed, sizeof failed);  // ends empty when exec closed it
  close(failure_pipe[0]);
  if (got == static_cast<ssize_t>(sizeof failed)) {
    waitpid(pid, nullptr, 0);
    return Error{path, std::strerror(failed)};
  }
  return ChildProcess(pid);
}

std::optional<ProcessEnd> ChildProcess::ended() {
  if (end_) return end_;
  int status = 0;
  const pid_t reaped = waitpid(pid_, &status, WNOHANG);
  if (reaped == 0) return std::nullopt;
  end_ = ProcessEnd{};
  if (reaped != pid_) {
    end_->exit_code = kExitCheckFailed;  // SIGCHLD is ignored: it has ended, and how has not been kept
  } else if (WIFSIGNALED(status)) {
    end_->signal = WTERMSIG(status);
  } else {
    end_->exit_code = WEXITSTATUS(status);
  }
  return end_;
}

void ChildProcess::send_signal(int signal) const {
  if (!end_) kill(pid_, signal);
}

std::filesystem::path program_beside_us(const std::string& name) {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / name;
}

std::optional<std::filesystem::path> find_in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string directories = path != nullptr ? path : "/usr/bin:/bin";
  for (std::size_t start = 0; start <= directories.size();) {
    const std::size_t end = std::min(directories.find(':', start), directories.size());
    const std::filesystem::path candidate = std::filesystem::path(directories.substr(start, end - start)) / name;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
    start = end + 1;
  }
  return std::nullopt;
}

}  // namespace phare
