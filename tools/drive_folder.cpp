#include "tools/drive_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "config/drive_names.h"

namespace phare {

namespace fs = std::filesystem;

Result<FolderClaim> claim_folder(const fs::path& out) {
  const int folder = open(out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return Error{out.string(), std::strerror(errno)};
  const FolderClaim claim(nullptr, [folder](void*) { close(folder); });
  // A file system without locks has none of other drives either.
  if (flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return Error{out.string(), "another drive is filling it"};
  return claim;
}

void remove_half_written(const fs::path& out, const std::vector<std::string>& process_names) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(out, ignored)) {
    const std::string file = entry.path().filename().string();
    for (const std::string& name : process_names) {
      if (file.starts_with(name + ".json.tmp")) fs::remove(entry.path(), ignored);
    }
  }
}

namespace {

/// Folders of the channels beside the first, by the report that is there.
std::vector<fs::path> channel_folders(const fs::path& out) {
  std::vector<fs::path> folders;
  std::ifstream stream(out / "report.json");
  const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
  if (!report.is_object() || !report.value("processes", nlohmann::json()).is_object()) return folders;
  for (const auto& [name, process] : report["processes"].items()) {
    if (!name.starts_with("visual-") || name == "visual-0" || !process.is_object()) continue;
    const nlohmann::json channel = process.value("channel", nlohmann::json());
    if (!channel.is_string()) continue;
    const fs::path folder(channel.get<std::string>());
    if (!folder.empty() && folder == folder.filename() && folder != "." && folder != "..")
      folders.push_back(out / folder);
  }
  return folders;
}

/// What a link points at, there or not yet.
fs::path behind_links(fs::path file) {
  std::error_code failed;
  for (int links = 0; links < 40 && fs::is_symlink(file, failed); ++links)
    file = file.parent_path() / fs::read_symlink(file, failed);
  return file;
}

/// 000007.png
bool is_frame(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".png" && std::ranges::all_of(stem, [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

void remove_earlier_output(const fs::path& out, const std::vector<std::string>& process_names) {
  std::error_code ignored;
  for (const fs::path& folder : channel_folders(out)) {
    remove_earlier_output(folder, {});
    fs::remove(folder / kDriveFrames, ignored);  // only when empty, as the folder
    fs::remove(folder, ignored);
  }
  for (const std::string_view file : kDriveFiles) fs::remove(out / file, ignored);
  for (const std::string& name : process_names) fs::remove(out / (name + ".json"), ignored);
  remove_half_written(out, process_names);
  for (const auto& entry : fs::directory_iterator(out, ignored))
    if (is_picture_of_design(entry.path().filename().string())) fs::remove(entry.path(), ignored);
  for (const auto& entry : fs::directory_iterator(out / kDriveFrames, ignored))
    if (is_frame(entry.path())) fs::remove(entry.path(), ignored);
}

Status apart_from_output(const fs::path& file, const fs::path& out, const Rig& rig) {
  std::error_code failed;
  fs::path within = fs::weakly_canonical(behind_links(fs::absolute(file)), failed)
                        .lexically_relative(fs::weakly_canonical(fs::absolute(out), failed));
  if (failed || within.empty()) return Done{};  // told where it is made
  std::vector<std::string> processes{"cockpit", "dynamics"};
  for (std::size_t channel = 0; channel < rig.channels.size(); ++channel) {
    processes.push_back("visual-" + std::to_string(channel));
    // The first channel's pictures lie in the folder itself, those of each other one in a folder below.
    const std::string& name = rig.channels[channel].name;
    if (channel > 0 && within.begin()->string() == name) within = within.lexically_relative(name);
  }
  const std::string name = within.string();
  const bool ours = name == "." || name == kDriveFrames || name == "rig.toml" ||
                    std::ranges::find(kDriveFiles, name) != kDriveFiles.end() ||
                    std::ranges::any_of(processes, [&](const auto& process) { return name == process + ".json"; }) ||
                    is_picture_of_design(name) || (within.parent_path() == kDriveFrames && is_frame(within));
  if (!ours) return Done{};
  return Error{file.string(), "is a file that the drive itself writes into " + out.string()};
}

namespace {
/// Without the one that says nothing of what was driven.
nlohmann::json words_of(nlohmann::json command) {
  std::erase(command.get_ref<nlohmann::json::array_t&>(), "--overwrite");
  return command;
}
}  // namespace

std::string another_drive_in(const fs::path& out, const std::vector<std::string>& command) {
  std::error_code ignored;
  if (std::ifstream stream(out / "report.json"); stream) {
    const nlohmann::json report = nlohmann::json::parse(stream, nullptr, false);
    const nlohmann::json there = report.is_object() ? report.value("command", nlohmann::json()) : nlohmann::json();
    if (there.is_array() && words_of(there) == words_of(command)) return {};
    const std::string made_at = report.is_object() ? report.value("made_at", std::string()) : std::string();
    return made_at.empty() ? "the report of another drive" : "the drive of " + made_at;
  }
  const fs::directory_iterator frames(out / kDriveFrames, ignored);
  const bool any = std::any_of(begin(frames), end(frames),
                               [](const fs::directory_entry& entry) { return entry.path().extension() == ".png"; });
  return any ? "the pictures of another drive" : "";
}

std::string numbered(const std::string& path, int number) {
  if (path.empty() || number == 1) return path;
  const fs::path first(path);
  return (first.parent_path() / (first.stem().string() + "-" + std::to_string(number) + first.extension().string()))
      .string();
}

fs::path first_missing(fs::path out) {
  fs::path missing;
  for (; !out.empty() && !fs::exists(out); out = out.parent_path()) missing = out;
  return missing;
}

void remove_made(fs::path out, const fs::path& made) {
  std::error_code ignored;
  for (; !made.empty(); out = out.parent_path()) {
    fs::remove(out, ignored);  // only when empty
    if (out == made) break;
  }
}

void remove_traces(const fs::path& out, const fs::path& made, const std::vector<std::string>& process_names) {
  remove_earlier_output(out, process_names);
  std::error_code ignored;
  fs::remove(out / kDriveFrames, ignored);  // only when empty
  remove_made(out, made);
}

}  // namespace phare
