// What tests of batch runs write, start and read.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/paths.h"

namespace phare::test {

inline std::string written(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + name;
  std::ofstream(file) << text;
  return file;
}

inline constexpr const char* kBraking =
    "time_s,steer_rad,accelerator_01,brake_01\n0,0,0,0\n1,0,0,0\n1.2,0,0,0.3\n2.5,0,0,0.3\n";

/// Exit code of phare-dynamics; `said`: its stderr.
inline int program(const std::string& arguments, std::string* said = nullptr) {
  const std::string errors = testing::TempDir() + "program_errors.txt";
  const int status = std::system(
      (std::string(phare::program("phare-dynamics")) + " " + arguments + " >/dev/null 2>" + errors).c_str());
  std::stringstream text;
  text << std::ifstream(errors).rdbuf();
  if (said) *said = text.str();
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

inline std::string content(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace phare::test
