// phare lamp: the photometry bench on the command line.
#include "config/base/input_files.h"
#include "config/finite_numbers.h"
#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "visual/photometry/readers/file_text.h"

namespace phare {
namespace {

/// What every command that reads a lamp file takes.
void add_reading(CLI::App* command, LampReadSettings& settings) {
  command
      ->add_option_function<std::string>(
          "--axis",
          [&settings](const std::string& v) {
            settings.axis = v == "gamma90" ? GammaAxis::kGamma90 : GammaAxis::kGamma0;
          },
          "Type C and EULUMDAT: gamma0 = the optical axis is gamma 0, gamma90 = it is C 0, gamma 90")
      ->check(CLI::IsMember({"gamma0", "gamma90"}))
      ->default_str("gamma0");
  command
      ->add_option("--c0", settings.c0_turn_deg, "Type C and EULUMDAT: plane C 0 lies at this angle (0 right, 90 up)")
      ->check(number_within(-360.0, 360.0))
      ->capture_default_str();
  command->add_option("--lamp-set", settings.lamp_set, "EULUMDAT: lamp set to use, from 1")
      ->check(number_within(1.0, 1e6))
      ->capture_default_str();
  command->add_option("--emitter", settings.emitter, "TM-33: emitter to use, from 1")
      ->check(number_within(1.0, 1e6))
      ->capture_default_str();
  command->add_option("--distance", settings.distance_m, "CSV in lx without a distance_m: metres")
      ->check(number_within(1e-3, 1e6));
  command->add_flag("--mirror", settings.mirror_h, "Turn left and right round while reading (clockwise type B)");
  command
      ->add_option_function<std::string>(
          "--format",
          [&settings](const std::string& v) {
            settings.format = v == "lm63"       ? LampFormat::kLm63
                              : v == "eulumdat" ? LampFormat::kEulumdat
                              : v == "tm33"     ? LampFormat::kTm33
                                                : LampFormat::kCsv;
          },
          "Format of the file [found by its content]")
      ->check(CLI::IsMember({"lm63", "eulumdat", "tm33", "csv"}));
}

/// What a command reads, and the files it may write.
struct Touched {
  std::vector<std::string> inputs, results = {};
};

/// Runs a command unless two of its inputs are standard input or a result would be written over an input.
template <typename Options>
void run_with(CLI::App* command, const std::shared_ptr<Options>& options, Command& chosen, int (*run)(const Options&),
              Touched (*touched)(const Options&)) {
  command->callback([options, &chosen, run, touched] {
    chosen = [options, run, touched] {
      const Touched files = touched(*options);
      if (const Status apart = check_inputs(files.inputs, files.results); !apart) return bad_input(apart.error());
      return run(*options);
    };
  });
}

/// The pictures of a folder, by their stems.
std::vector<std::string> pictures(const std::string& folder, const std::vector<std::string>& stems) {
  std::vector<std::string> files;
  for (const std::string& stem : stems) {
    for (const char* ending : {".svg", ".png"}) files.push_back(folder + "/" + stem + ending);
  }
  return files;
}

void add_info(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampInfoOptions>();
  CLI::App* command = lamp->add_subcommand("info", "What a photometry file is, and what is odd about it");
  command->footer("Example:\n  phare lamp info low_beam.ies --json");
  command->add_option("files", options->files, "Photometry files")->required();
  command->add_flag("--json", options->json, "For machines");
  command->add_flag("--strict", options->strict, "Exit code 1 when a finding is an error");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_info, +[](const LampInfoOptions& o) { return Touched{o.files}; });
}

void add_table(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampTableOptions>();
  CLI::App* command =
      lamp->add_subcommand("table", "Intensity in directions: at pairs of the table's own angles, or at H,V");
  command->footer(
      "Example:\n  phare lamp table low_beam.ies --at angles.csv --out intensity.csv\n"
      "  phare lamp table low_beam.ies --hv 0,0 -3.43,0.57");
  command->add_option("file", options->file, "Photometry file")->required();
  CLI::Option* at = command->add_option("--at", options->at,
                                        "CSV with h_deg,v_deg, the table's own two angles (type C: C and gamma)");
  command
      ->add_option("--hv", options->hv,
                   "H,V in degrees, right and up from the optical axis, whatever the file's own angles; any number")
      ->excludes(at);
  command->add_option("--out", options->out, "CSV to write; adds intensity_cd [standard output]");
  command->add_flag("--json", options->json, "For machines; --out names the CSV to write as well");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_table, +[](const LampTableOptions& o) {
        return Touched{{o.file, o.at}, {o.out}};
      });
}

void add_check(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampCheckOptions>();
  CLI::App* command =
      lamp->add_subcommand("check", "Judge a beam by a rulebook; exit code 1 when a row fails or the file lacks data");
  command->footer(
      "Example:\n  phare lamp check low_beam.ies --rule r112-passing-b --json\n  phare lamp check low_beam.ies "
      "--rule r112-passing-b --rule r149-passing-c --out out/check.html\n  phare lamp check --list");
  command->add_option("files", options->files,
                      "One file, or left and right (rules of half the sum); or a laboratory's list of points");
  command
      ->add_option("--rule", options->rules,
                   "Rulebook of config/rules, or a .toml file; repeat for more. all: every one for this kind of beam")
      ->allow_extra_args(false);
  command->add_option("--market", options->market, "Every rule of this market for this kind of beam: ECE or US")
      ->check(CLI::IsMember({"ECE", "EU", "UN", "US", "USA"}, CLI::ignore_case));
  command->add_option("--function", options->function, "Kind of beam for --rule all and --market [by the beam]")
      ->check(CLI::IsMember({"low", "high", "fog"}));
  command->add_option("--beam", options->beam, "Of a list of points with several beams, this one [all]");
  command->add_option("--out", options->out, "HTML page to write: rules, then all rows, the worst first");
  command->add_option("--traffic", options->traffic, "Side of the road [by the cut-off]")
      ->check(CLI::IsMember({"find", "right", "left"}))
      ->capture_default_str();
  command->add_option("--aim-up", options->aim_up_deg, "Turn the lamp up by this, deg, instead of the rule's aim");
  command->add_option("--aim-right", options->aim_right_deg,
                      "Turn the lamp right by this, deg, instead of the rule's aim");
  command->add_flag("!--no-reaim", options->reaim, "Do not use the rule's re-aim allowance");
  command->add_option("--aim", options->aim,
                      "Which of the rule's aims, as marked on the lens: VOL or VOR [by the beam]");
  command->add_flag("--led-module", options->led_module, "The light source is an LED module with control gear");
  command->add_flag("--list", options->list, "List the rulebooks");
  command->add_flag("--json", options->json, "For machines");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_check, +[](const LampCheckOptions& o) {
        Touched files{o.files, {o.out}};
        files.inputs.insert(files.inputs.end(), o.rules.begin(), o.rules.end());
        return files;
      });
}

void add_convert(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampConvertOptions>();
  CLI::App* command =
      lamp->add_subcommand("convert", "Write a lamp as LM-63-2019, EULUMDAT or CSV; several files are summed");
  command->footer(
      "Example:\n  phare lamp convert low_beam.ies --out low_beam.ldt\n  phare lamp convert low_beam.ies --mirror "
      "--out "
      "low_beam_lht.ies");
  command->add_option("files", options->files, "Photometry files")->required();
  command->add_option("--out", options->out, "File to write: .ies, .ldt or .csv")->required();
  command->add_option("--to", options->format, "Format to write [by the ending]")
      ->check(CLI::IsMember({"lm63", "eulumdat", "csv"}));
  command
      ->add_option_function<std::string>(
          "--out-axis",
          [options](const std::string& v) {
            options->out_axis = v == "gamma90" ? GammaAxis::kGamma90 : GammaAxis::kGamma0;
            options->out_axis_given = true;
          },
          "EULUMDAT: where the optical axis is put; gamma90 keeps the nodes of type A")
      ->check(CLI::IsMember({"gamma0", "gamma90"}))
      ->default_str("gamma0");
  command->add_flag("--json", options->json, "For machines");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_convert, +[](const LampConvertOptions& o) {
        return Touched{o.files, {o.out}};
      });
}

void add_mounting(CLI::App* command, double& height_m, double& spacing_m, double& pitch_deg, bool& given) {
  command->add_option("--height", height_m, "Height of the lamps above the road, m")
      ->check(number_within(0.1, 5.0))
      ->capture_default_str();
  command->add_option("--spacing", spacing_m, "Distance between the lamps, m")
      ->check(number_within(0.0, 5.0))
      ->capture_default_str();
  command->add_option_function<double>(
      "--pitch-deg",
      [&pitch_deg, &given](double value) {
        pitch_deg = value;
        given = true;
      },
      "Aim, deg, up positive [a passing beam: cut-off on 0.57 deg down; others as filed]");
}

void add_compare(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampCompareOptions>();
  CLI::App* command = lamp->add_subcommand(
      "compare", "Two beams, aligned by cut-off: difference and ratio in angle space and on the road");
  command->footer("Example:\n  phare lamp compare low_beam.ies led_low_beam.ies --out out/compare");
  command->add_option("a", options->a, "Photometry file A")->required();
  command->add_option("b", options->b, "Photometry file B")->required();
  command->add_option("--out", options->out, "Folder for ratio and difference as .svg and .png");
  command->add_flag("!--no-align", options->align, "Compare as filed");
  command->add_flag("--mirror-b", options->mirror_b, "Turn B left to right first");
  command->add_option("--height", options->height_m, "Height of the lamps above the road, m")
      ->check(number_within(0.1, 5.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "For machines");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_compare, +[](const LampCompareOptions& o) {
        return Touched{{o.a, o.b}, pictures(o.out, {"ratio", "difference"})};
      });
}

void add_plot(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampPlotOptions>();
  CLI::App* command =
      lamp->add_subcommand("plot", "25 m wall, isocandela, bird's-eye isolux, vertical cut, false colour: SVG and PNG");
  command->footer("Example:\n  phare lamp plot low_beam.ies --rule r112-passing-b --out out/plots");
  command->add_option("files", options->files, "One file, or left and right")->required();
  command->add_option("--out", options->out, "Folder to write into")->required();
  command->add_option("--rule", options->rule, "Rulebook whose rows are drawn with pass and fail");
  command->add_option("--beam", options->beam, "Of a list of points with several beams, this one [all]");
  command->add_option("--view", options->views, "Draw this view alone; repeat for more [all]")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kPlotViews), std::end(kPlotViews))))
      ->allow_extra_args(false);
  add_mounting(command, options->height_m, options->spacing_m, options->pitch_deg, options->pitch_given);
  command->add_flag("--json", options->json, "For machines");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_plot, +[](const LampPlotOptions& o) {
        std::vector<std::string> stems;
        for (const char* view : kPlotViews) {
          for (const char* lamp : {"", "_left", "_right"}) stems.push_back(std::string(view) + lamp);
        }
        return Touched{o.files, pictures(o.out, stems)};
      });
}

void add_hspr(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampHsprOptions>();
  CLI::App* command = lamp->add_subcommand(
      "hspr", "HSPR of a pair (GTB CE-5815): ranges, widths, flux, glare, points, score and class");
  command->footer(
      "Each row has the method's figure and the physical one; points, score and class are the method's.\n"
      "Example:\n  phare lamp hspr low_beam.ies low_beam.ies\n  phare lamp hspr low_beam.ies low_beam.ies --high "
      "high_beam.ies high_beam.ies");
  command->add_option("left", options->left, "Photometry file of the left lamp")->required();
  command->add_option("right", options->right, "Photometry file of the right lamp")->required();
  command->add_option("--beam", options->beam, "Which method [low where there is a kinked cut-off]")
      ->check(CLI::IsMember({"find", "low", "high"}))
      ->capture_default_str();
  command->add_option("--high", options->high, "Driving beam beside the passing beam, left and right: rates the system")
      ->expected(2);
  command
      ->add_option(
          "--adb", options->adb,
          "With --high: SITUATION LEFT RIGHT of an adaptive driving beam, as filed; six times, for oncoming-50, "
          "-100, -200 and preceding-50, -100, -200")
      ->type_size(3)
      ->expected(1, 6)
      ->allow_extra_args(false);
  add_mounting(command, options->height_m, options->spacing_m, options->pitch_deg, options->pitch_given);
  command->add_flag("--json", options->json, "For machines");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_hspr, +[](const LampHsprOptions& o) {
        Touched files{{o.left, o.right}};
        files.inputs.insert(files.inputs.end(), o.high.begin(), o.high.end());
        for (std::size_t i = 0; i < o.adb.size(); ++i) {
          if (i % 3 != 0) files.inputs.push_back(o.adb[i]);
        }
        return files;
      });
}

void add_levels(CLI::App* lamp, Command& chosen) {
  auto options = std::make_shared<LampLevelsOptions>();
  CLI::App* command =
      lamp->add_subcommand("levels", "Error and bytes of every level of beam image; time of recomposing one");
  command->footer("Example:\n  phare lamp levels low_beam.ies --bench");
  command->add_option("file", options->file, "Photometry file; without one --bench alone");
  command->add_flag("--bench", options->bench, "Also time the recomposition of 1801 x 601 texels from 36 sources");
  command->add_flag("--json", options->json, "For machines");
  add_reading(command, options->settings);
  run_with(
      command, options, chosen, lamp_levels, +[](const LampLevelsOptions& o) { return Touched{{o.file}}; });
}

}  // namespace

std::string rules_folder() {
  return config_path("rules");
}

void add_lamp(CLI::App& app, Command& chosen) {
  CLI::App* lamp =
      app.add_subcommand("lamp", "The photometry bench: info, table, check, plot, compare, convert, hspr, levels");
  lamp->footer(
      "A file named \"-\" is standard input.\n"
      "Example:\n  phare lamp info low_beam.ies\n  phare lamp plot low_beam.ies --rule r149-passing-c --out out/plots");
  lamp->require_subcommand(1);
  add_info(lamp, chosen);
  add_table(lamp, chosen);
  add_check(lamp, chosen);
  add_convert(lamp, chosen);
  add_compare(lamp, chosen);
  add_plot(lamp, chosen);
  add_hspr(lamp, chosen);
  add_levels(lamp, chosen);
}

}  // namespace phare
