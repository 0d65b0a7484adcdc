// Number columns of a CSV file with a header line.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// The named columns, in the order asked for, in any order in the file; other columns are passed over. Blank lines and
/// lines that begin with # are skipped. Error with file:line when a column is missing or a value is no finite number.
Result<std::vector<std::vector<double>>> read_csv_columns(const std::filesystem::path& file,
                                                          std::span<const std::string> names);

}  // namespace phare
