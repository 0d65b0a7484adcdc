// Runs `phare lamp …` and others as a user does, and keeps what it said.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/paths.h"

namespace phare::test {

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream content;
  content << stream.rdbuf();
  return content.str();
}

/// A folder for one test, gone at its end.
class LampProgram : public testing::Test {
 protected:
  LampProgram() : folder_(std::filesystem::path(testing::TempDir()) / ("phare_lamp_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~LampProgram() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return in(name);
  }
  /// A lamp of ours.
  static std::string ours(const std::string& name) { return std::string(lamps_dir() + "/") + name; }

  struct Said {
    int code = 0;
    std::string out, err;
  };
  Said lamp(const std::string& arguments) const { return phare("lamp " + arguments); }
  /// `arguments` as a shell reads them, redirections included; what is not redirected comes back.
  Said phare(const std::string& arguments) const {
    const std::string out = in("stdout.txt"), err = in("stderr.txt");
    const int status =
        std::system(("{ \"" + program("phare") + "\" " + arguments + "; } >'" + out + "' 2>'" + err + "'").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(out), content_of(err)};
  }

  std::filesystem::path folder_;
};

}  // namespace phare::test
