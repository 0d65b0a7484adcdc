// Python packages as oracles: an environment made once under build/, and what a command in it prints.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tests/paths.h"

namespace phare {

/// Standard output of a command and its exit status.
inline std::pair<std::string, int> output_of(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {out, -1};
  std::array<char, 65536> part{};
  for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) out.append(part.data(), n);
  const int status = pclose(pipe);
  return {out, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

/// Status 77 and the reason where there is no Python or no network.
inline std::pair<std::string, int> make_oracle_venv() {
  return output_of(tests_dir("cockpit_io") + "/oracle_venv.sh " + build_root("oracle"));
}
/// The same for build_root("oracle_mf4"), whose python-can reads and writes MF4.
inline std::pair<std::string, int> make_mf4_venv() {
  return output_of(tests_dir("cockpit_io") + "/oracle_venv.sh " + build_root("oracle_mf4") +
                   " 'python-can==4.6.1 asammdf==8.8.28'");
}

/// "-" is none.
inline std::vector<std::uint8_t> bytes_of(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; hex != "-" && i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

}  // namespace phare
