// What the tests of the rulebooks share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/paths.h"
#include "visual/photometry/bench/check.h"

namespace phare::test {

inline Rulebook rule(const std::string& name) {
  auto found = find_rulebook(rules_dir(), name);
  EXPECT_TRUE(found.ok()) << found.error().text();
  return found.ok() ? std::move(*found) : Rulebook{};
}

inline CheckResult check(const IntensityTable& table, const Rulebook& rulebook, const CheckOptions& options = {}) {
  const IntensityTable* tables[] = {&table};
  return check_lamp(tables, rulebook, options);
}

inline const CheckRow& row_of(const CheckResult& result, const std::string& id) {
  return *std::find_if(result.rows.begin(), result.rows.end(), [&](const CheckRow& r) { return r.id == id; });
}

}  // namespace phare::test
