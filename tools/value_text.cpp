#include "tools/value_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

namespace phare {
namespace {

__extension__ using Wide = __int128;

constexpr int kMostDecimals = 30;
constexpr std::size_t kDigitsOfDouble = 17;

/// digits · 10^exponent
struct Decimal {
  Wide digits = 0;
  int exponent = 0;
};

Decimal decimal_of(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr;
  Decimal decimal;
  bool behind_point = false;
  const char* c = text;
  for (; c != end && *c != 'e'; ++c) {
    if (*c == '.') behind_point = true;
    if (*c < '0' || *c > '9') continue;
    decimal.digits = decimal.digits * 10 + (*c - '0');
    decimal.exponent -= behind_point ? 1 : 0;
  }
  if (value < 0.0) decimal.digits = -decimal.digits;
  if (c == end) return decimal;
  int power = 0;
  c += c[1] == '+' ? 2 : 1;
  std::from_chars(c, end, power);
  decimal.exponent += power;
  return decimal;
}

/// The number times 10^decimals; nullopt: beyond 127 bits.
std::optional<Wide> scaled(const Decimal& number, int decimals) {
  Wide value = number.digits;
  for (int i = number.exponent + decimals; i > 0 && value != 0; --i)
    if (__builtin_mul_overflow(value, Wide{10}, &value)) return std::nullopt;
  return value;
}

/// raw · factor + offset exactly; empty where it does not fit.
std::string exact_text(const DbcSignal& signal, std::uint64_t raw) {
  const Decimal factor = decimal_of(signal.factor), offset = decimal_of(signal.offset);
  const int decimals = std::max({0, -factor.exponent, offset.digits == 0 ? 0 : -offset.exponent});
  if (decimals > kMostDecimals) return {};
  Wide number = static_cast<Wide>(raw);
  if (signal.type == DbcSignal::Type::kSigned && signal.length_bits < 64 && (raw >> (signal.length_bits - 1)) != 0)
    number -= Wide{1} << signal.length_bits;
  else if (signal.type == DbcSignal::Type::kSigned)
    number = static_cast<std::int64_t>(raw);
  const auto by = scaled(factor, decimals), plus = scaled(offset, decimals);
  if (!by || !plus || __builtin_mul_overflow(number, *by, &number) || __builtin_add_overflow(number, *plus, &number))
    return {};
  const bool negative = number < 0;
  std::string digits;  // the last first
  for (; number != 0 || digits.size() <= static_cast<std::size_t>(decimals); number /= 10) {
    const int digit = static_cast<int>(number % 10);
    digits += static_cast<char>('0' + (negative ? -digit : digit));
  }
  std::string fraction = digits.substr(0, static_cast<std::size_t>(decimals));
  fraction.erase(0, std::min(fraction.find_first_not_of('0'), fraction.size()));
  std::string whole = digits.substr(static_cast<std::size_t>(decimals));
  const std::size_t significant = (whole == "0" ? 0 : whole.size()) + fraction.size();
  if (!fraction.empty() && significant > kDigitsOfDouble) return {};
  std::ranges::reverse(whole);
  std::ranges::reverse(fraction);
  return (negative ? "-" : "") + whole + (fraction.empty() ? "" : "." + fraction);
}

}  // namespace

std::string shortest_text(double value) {
  char text[40];
  if (value == 0.0) return "0";
  if (std::abs(value) < 0x1p53 && value == std::trunc(value)) {
    std::snprintf(text, sizeof text, "%.0f", value);
    return text;
  }
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string value_text(const DbcSignal& signal, std::uint64_t raw, double value) {
  const bool whole = signal.type == DbcSignal::Type::kUnsigned || signal.type == DbcSignal::Type::kSigned;
  const std::string exact = whole ? exact_text(signal, raw) : std::string();
  return exact.empty() ? shortest_text(value) : exact;
}

}  // namespace phare
