// unit: every way a TOML file can be wrong gives one error with file, line and reason.
#include "config/formats/toml_table.h"

#include <gtest/gtest.h>

#include <array>

namespace phare {
namespace {

/// The error of a document after `ask` has read it.
template <typename Ask>
std::string error_of(std::string_view text, Ask ask) {
  auto table = TomlTable::parse(text, "car.toml");
  if (!table) return table.error().text();
  ask(*table);
  const Status status = table->finish();
  return status ? "" : status.error().text();
}

TEST(TomlTable, ReadsEveryKind) {
  auto table = TomlTable::parse(R"(mass_kg = 1200
name = "hatch"
abs = true
axles = 2
offset_m = [1, 2.5, 3]
tags = ["a", "b"]
[tyre]
width_m = 0.2
[[lamp]]
x_m = 1.0
[[lamp]]
x_m = 2.0
)",
                                "car.toml");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->number("mass_kg", 0, 5000), 1200.0);
  EXPECT_EQ(table->text("name"), "hatch");
  EXPECT_TRUE(table->flag_or("abs", false));
  EXPECT_TRUE(table->is_text("name") && !table->is_text("abs") && !table->is_text("nowhere"));
  EXPECT_EQ(table->integer("axles", 1, 4), 2);
  EXPECT_EQ(table->numbers("offset_m", 3), (std::vector<double>{1, 2.5, 3}));
  EXPECT_EQ(table->texts_or_empty("tags"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table->table("tyre").number("width_m", 0, 1), 0.2);
  auto lamps = table->tables("lamp");
  ASSERT_EQ(lamps.size(), 2u);
  EXPECT_EQ(lamps[0].number("x_m", 0, 5), 1.0);
  EXPECT_EQ(lamps[1].number("x_m", 0, 5), 2.0);
  EXPECT_EQ(lamps[1].place("x_m"), "car.toml:12");
  EXPECT_FALSE(table->table_if("engine").has_value());
  EXPECT_EQ(table->number_or("drag", 0.3, 0, 1), 0.3);
  EXPECT_TRUE(table->finish());
}

TEST(TomlTable, SyntaxErrorHasLine) {
  EXPECT_TRUE(error_of("a = 1\nb = = 2\n", [](TomlTable&) {}).starts_with("car.toml:2: "));
}

TEST(TomlTable, UnknownKeyNamesNearest) {
  EXPECT_EQ(error_of("mas_kg = 3\n", [](TomlTable& t) { t.number("mass_kg", 0, 10); }),
            "car.toml:1: no key \"mas_kg\"; did you mean \"mass_kg\"?");
  EXPECT_EQ(error_of("\n\n[tyre]\nwidth = 3\n", [](TomlTable& t) { t.table("tyre").number_or("width_m", 1, 0, 10); }),
            "car.toml:4: no key \"width\"; did you mean \"width_m\"? (in tyre)");
  EXPECT_EQ(error_of("zzzzzz = 3\n", [](TomlTable& t) { t.text_or("name", ""); }),
            "car.toml:1: no key \"zzzzzz\"; there is name");
}

TEST(TomlTable, MissingWrongTypeRange) {
  EXPECT_EQ(error_of("b = 1\n",
                     [](TomlTable& t) {
                       t.number_or("b", 0, 0, 2);
                       t.number("a", 0, 1);
                     }),
            "car.toml:1: missing key \"a\"");
  EXPECT_EQ(error_of("a = 1\nb = \"x\"\n",
                     [](TomlTable& t) {
                       t.number("a", 0, 1);
                       t.number("b", 0, 1);
                     }),
            "car.toml:2: \"b\": expected a finite number");
  EXPECT_EQ(error_of("a = 7.5\n", [](TomlTable& t) { t.number("a", 0, 1); }),
            "car.toml:1: \"a\": 7.5 is outside 0 … 1");
  EXPECT_EQ(error_of("a = nan\n", [](TomlTable& t) { t.number("a", 0, 1); }),
            "car.toml:1: \"a\": expected a finite number");
  EXPECT_EQ(error_of("a = 1.5\n", [](TomlTable& t) { t.integer("a", 0, 9); }),
            "car.toml:1: \"a\": expected a whole number");
  EXPECT_EQ(error_of("a = [1, 2]\n", [](TomlTable& t) { t.numbers("a", 3); }),
            "car.toml:1: \"a\": expected an array of 3 finite numbers");
  EXPECT_EQ(error_of("a = 1\n", [](TomlTable& t) { t.table("a").number("x", 0, 1); }),
            "car.toml:1: \"a\": expected a table");
  EXPECT_EQ(error_of("[[l]]\nx = 1\n[[l]]\n",
                     [](TomlTable& t) {
                       for (auto& l : t.tables("l")) l.number("x", 0, 1);
                     }),
            "car.toml:3: missing key \"l.x\"");
  constexpr std::array<std::string_view, 2> kinds{"low", "high"};
  EXPECT_EQ(error_of("a = \"lo\"\n", [&](TomlTable& t) { t.choice("a", kinds); }),
            "car.toml:1: \"a\": \"lo\" is none of low, high");
}

TEST(TomlTable, MissingFile) {
  const auto table = TomlTable::read("/nowhere/rig.toml");
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().text(), "/nowhere/rig.toml: no such file");
}

}  // namespace
}  // namespace phare
