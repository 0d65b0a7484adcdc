// Many rules on one page: each with its verdict, then all rows, the worst first.
#pragma once

#include <span>
#include <string>

#include "tools/lamp/check_text.h"

namespace phare {

/// A row with the rule it is of.
struct PageRow {
  const Judged* judged = nullptr;
  const CheckRow* row = nullptr;
};

/// Failed rows, then those without data, within the resolution, passing by re-aim, passing; in each the one with the
/// least margin in parts of its limit first. Rows that are merely not measured come after everything that was.
std::vector<PageRow> worst_first(std::span<const Judged> all);

/// The margin in parts of the limit that it is of, %; 0 where there is no value.
double margin_percent(const CheckRow& row);

/// What the page is headed by: the beam, why it is taken for this function, which rules were asked for.
struct PageHead {
  std::string beams, function, market;
};

void print_page(const PageHead& head, std::span<const Judged> all);
std::string html_page(const PageHead& head, std::span<const Judged> all);

}  // namespace phare
