// A DBC file that has every kind of signal, and cockpit files for it, piece by piece.
#pragma once

#include <string>

namespace phare::test {

// One byte for each thing, so that a frame can be written out.
inline constexpr const char* kDbc =
    "BO_ 1 A: 8 X\n SG_ S0 : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ S1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
    " SG_ S2 : 16|8@1+ (1,0) [0|0] \"\" X\n SG_ ANGLE : 24|16@1+ (0.1,0) [0|0] \"deg\" X\n"
    " SG_ COUNT : 40|4@1+ (1,0) [0|0] \"\" X\n SG_ CRC : 56|8@1+ (1,0) [0|0] \"\" X\n"
    "BO_ 2 M: 2 X\n SG_ WHICH M : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ FLASHER m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
    " SG_ FOGGER m2 : 8|8@1+ (1,0) [0|0] \"\" X\n"
    "BO_ 3 OUT: 8 X\n SG_ HIGH : 0|1@1+ (1,0) [0|1] \"\" X\n SG_ KMH : 8|8@1+ (1,0) [0|255] \"\" X\n"
    " SG_ COUNT : 16|4@1+ (1,0) [0|0] \"\" X\n SG_ CRC : 56|8@1+ (1,0) [0|0] \"\" X\n"
    "VAL_ 1 S0 0 \"rest\" 1 \"pushed\" 2 \"pulled\" 3 \"half\" 7 \"faulty\";\n"
    "VAL_ 1 COUNT 13 \"INVALID\" 14 \"SNA\";\n"
    "VAL_ 1 S2 0 \"off\" 1 \"on\" 255 \"LIGHT_SNA\" 254 \"NASNA\";\n";

inline std::string can(const std::string& rest, const std::string& source = "") {
  return "[source]\nkind = \"log\"\n" + source + rest;
}
inline std::string control(const std::string& name, const std::string& signal, const std::string& rest = "",
                           const std::string& message = "A") {
  return "[control." + name + "]\nmessage = \"" + message + "\"\nsignal = \"" + signal + "\"\n" + rest;
}

}  // namespace phare::test
