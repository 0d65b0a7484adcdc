// Numbers of the command line are numbers.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>

namespace phare {

/// The number that `text` writes in decimal digits, with a point or an exponent; none for nan, inf, 0x10 and words.
inline std::optional<double> finite_number(const std::string& text) {
  const char *first = text.data() + (text.starts_with('+') ? 1 : 0), *last = text.data() + text.size();
  double value = 0.0;
  const auto read = std::from_chars(first, last, value);
  return read.ec == std::errc{} && read.ptr == last && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Like CLI::Range, in a number's own digits.
inline CLI::Validator number_within(double least, double most) {
  char range[64];
  std::snprintf(range, sizeof range, "%g to %g", least, most);
  return CLI::Validator(
      [=, words = std::string(range)](const std::string& text) {
        const std::optional<double> value = finite_number(text);
        if (!value) return text + " is not a finite number";
        return *value >= least && *value <= most ? std::string() : text + " is not within " + words;
      },
      range);
}

/// Before a program parses: each of its options of type FLOAT, and of its subcommands', refuses nan, inf and 0x10, each
/// of type UINT what is below 0. CLI11 reads them as numbers: nan passes every comparison of a range, and -1 is 2^64 - 1.
inline void take_finite_numbers_only(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_name().starts_with("FLOAT"))
      option->check([](const std::string& text) { return finite_number(text) ? "" : text + " is not a finite number"; },
                    "");
    if (option->get_type_name().starts_with("UINT"))
      option->check([](const std::string& text) { return text.starts_with('-') ? text + " is less than 0" : ""; }, "");
  }
  for (CLI::App* subcommand : app.get_subcommands(nullptr)) take_finite_numbers_only(*subcommand);
}

}  // namespace phare
