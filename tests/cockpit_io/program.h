// phare-cockpit as a child process, for tests.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/paths.h"

namespace phare {

using namespace std::chrono_literals;

// Deadlines are generous: sanitizer builds on a busy machine take part.
inline constexpr auto kPatience = 20s;

class Program {
 public:
  /// `output`: where its standard output goes; empty: where the test's goes.
  Program(const std::vector<std::string>& arguments, const std::filesystem::path& errors,
          const std::filesystem::path& output = {}) {
    std::vector<std::string> words{program("phare-cockpit")};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      const int out = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      const int nothing = open("/dev/null", O_RDONLY);
      dup2(out, STDERR_FILENO);
      dup2(nothing, STDIN_FILENO);
      if (!output.empty()) dup2(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
      execv(pointers[0], pointers.data());
      _exit(127);
    }
  }
  ~Program() { end(SIGKILL); }

  /// Exit code, or 1000 + signal; -1 when it did not end in time.
  int end(int signal) {
    if (pid_ <= 0) return -1;
    if (signal != 0) kill(pid_, signal);
    const auto until = std::chrono::steady_clock::now() + kPatience;
    int status = 0;
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > until) return -1;
      std::this_thread::sleep_for(5ms);
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

}  // namespace phare
