// phare rig check, phare rig new: rig files before they are driven.
#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "config/base/fail.h"
#include "config/base/input_files.h"
#include "config/base/whole_file.h"
#include "config/rig_writer.h"
#include "tools/commands.h"
#include "tools/lamp/print_json.h"
#include "tools/lamp_design.h"
#include "tools/portable_rig.h"
#include "tools/rig_check.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

struct RigCheckOptions {
  std::string file;
  bool json = false;
};

int rig_check(const RigCheckOptions& options) {
  const RigFindings found = check_rig(options.file);
  if (options.json) {
    print_json(as_json(found, options.file));
  } else {
    for (const Error& error : found.problems) std::fprintf(stderr, "phare: %s\n", printable(error.text()).c_str());
    for (const std::string& text : found.warnings) std::printf("warning: %s\n", printable(text).c_str());
    for (const std::string& text : found.notes) std::printf("%s\n", printable(text).c_str());
    if (found.problems.empty())
      std::printf("%s: good, %zu warning(s)\n", input_name(options.file).c_str(), found.warnings.size());
  }
  return found.problems.empty() ? kExitDone : kExitBadInput;
}

struct RigNewOptions {
  std::string rig_file = config_path("rigs/country_road.toml");
  std::string out;
  LampFlags lamps;
  bool portable = false;
};

int rig_new(const RigNewOptions& options) {
  auto rig = read_rig(options.rig_file);
  if (!rig) return bad_input(rig.error());
  if (const Status status = check_rig_files(*rig); !status) return bad_input(status.error());
  if (options.portable && options.out.empty())
    return bad_input({"--portable", "copies into a folder beside the rig: give --out FILE"});
  if (!options.lamps.any())
    if (const Status status = nothing_of_a_lamp(options.lamps); !status) return bad_input(status.error());
  const fs::path out = options.out.empty() ? fs::path{} : fs::absolute(options.out).lexically_normal();
  std::error_code ignored;
  if (!out.empty() && fs::exists(out, ignored))
    return bad_input({out.string(), "is there already; a rig is not written over"});

  RigWords words;
  std::string told;  // of the lamps, when the rig is written: a refusal is one line
  if (options.lamps.any()) {
    const auto notes = put_lamp_design(*rig, options.lamps);
    if (!notes) return bad_input(notes.error());
    std::string says;
    for (const std::string& line : notes->lines) {
      says += line + "\n";
      told += printable(line) + "\n";
    }
    words.of_designs = {says};
    for (const std::string& line : notes->warnings) told += "warning: " + printable(line) + "\n";
    rig->name += ", " + rig->designs.front().name;
  }
  words.heading = "A rig of Phare: which car, road, lamps and windows belong together. Drive it: phare drive --rig " +
                  (out.empty() ? std::string("FILE") : out.filename().string()) +
                  "\nLook it over: phare rig check FILE. Every key, its unit and default: docs/rig-file.md. Paths are "
                  "relative to this file;\n\"generated/…\" is what the build of Phare made.";
  std::optional<PortableFiles> files;
  if (options.portable) {
    files.emplace(out.parent_path() / (out.stem().string() + "_files"));
    if (const Status status = files->copy(*rig); !status) return bad_input(status.error());
    words.path = [&](const fs::path& file) { return files->word(file); };
  } else {
    words.path = paths_from(out.empty() ? fs::path("/nonexistent") : out.parent_path(), !out.empty());
  }
  const std::string text = rig_text(*rig, words);
  if (out.empty()) {
    std::fputs(text.c_str(), stdout);
    std::fputs(told.c_str(), stderr);
    return kExitDone;
  }
  std::ofstream stream(out, std::ios::binary);
  stream << text;
  if (!stream.flush()) {
    if (options.portable) fs::remove_all(out.parent_path() / (out.stem().string() + "_files"), ignored);
    return bad_input({out.string(), "cannot be written"});
  }
  std::fputs(told.c_str(), stderr);
  std::printf("%s", out.string().c_str());
  if (files) std::printf(" and %zu files in %s_files", files->count(), out.stem().string().c_str());
  std::printf("\n");
  return kExitDone;
}

}  // namespace

void add_rig(CLI::App& app, Command& chosen) {
  CLI::App* rig = app.add_subcommand("rig", "Rig files: check one, write one");
  rig->footer(
      "Example:\n  phare rig check config/rigs/country_road.toml\n  phare rig new --lamp led_low_beam.ies --out "
      "my.toml");
  rig->require_subcommand(1);

  auto check = std::make_shared<RigCheckOptions>();
  CLI::App* check_command =
      rig->add_subcommand("check", "Reads a rig and every file it names; exit code 2 when it cannot be driven");
  check_command->footer("Example:\n  phare rig check config/rigs/country_road.toml");
  check_command->add_option("file", check->file, "Rig file; \"-\" is standard input")->required();
  check_command->add_flag("--json", check->json, "For machines");
  check_command->callback([check, &chosen] { chosen = [check] { return rig_check(*check); }; });

  auto made = std::make_shared<RigNewOptions>();
  CLI::App* new_command =
      rig->add_subcommand("new", "Writes a commented rig: another one with lamps of one's own as its first design");
  new_command->footer(
      std::string("Examples:\n  phare rig new --lamp led_low_beam.ies --out my.toml\n  phare rig new --rig "
                  "config/rigs/matrix.toml --out night/matrix.toml --portable\n") +
      kLampFlagsHelp);
  new_command->add_option("--rig", made->rig_file, "Rig to begin with")->capture_default_str();
  add_lamp_flags(new_command, made->lamps);
  new_command->add_option("--out", made->out, "File to write [standard output]");
  new_command->add_flag("--portable", made->portable,
                        "Copy everything it names into FILE_files beside it, so that both can be moved");
  new_command->callback([made, &chosen] {
    if (is_standard_output(made->out)) made->out.clear();
    chosen = [made] { return rig_new(*made); };
  });
}

}  // namespace phare
