// How a program says that it was given something wrong: one line, exit code 2.
#pragma once

#include <cstdio>

#include "config/result.h"

namespace phare {

/// Prints "program: place: reason" to stderr. Returns the exit code.
inline int fail(const char* program, const Error& error) {
  std::fprintf(stderr, "%s: %s\n", program, error.text().c_str());
  return kExitBadInput;
}

}  // namespace phare
