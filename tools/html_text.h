// Text of a page.
#pragma once

#include <cctype>
#include <string>

namespace phare {

/// As text or as the value of an attribute.
inline std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// A file's name as a relative address: what means something else in one is written by its number (RFC 3986, 2.1).
inline std::string percent_encoded(const std::string& name) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string result;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) || c == '/' || c == '-' || c == '.' || c == '_' || c == '~';
    if (plain)
      result += c;
    else
      result += {'%', kHex[byte / 16], kHex[byte % 16]};
  }
  return result;
}

}  // namespace phare
