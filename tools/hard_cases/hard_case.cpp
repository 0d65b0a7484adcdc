#include "tools/hard_cases/hard_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace phare::hard {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string bound_text(const std::optional<double>& bound) {
  return bound ? number(*bound) : "";
}

bool within(const std::optional<double>& bound, const std::vector<Found>& found) {
  return !bound || (!found.empty() && *worst(found) <= *bound);
}

constexpr double kWidth = 330.0, kHeight = 130.0, kLeft = 50.0, kRight = 12.0, kTop = 10.0, kBottom = 30.0;

/// Found numbers as points, the bound as a line; powers of ten upwards, 0 at the lower edge.
std::string plot(const HardCase& hard, const Outcome& outcome) {
  double low = 1e300, high = 0.0, first = 1e300, last = -1e300;
  const auto look = [&](double value) {
    if (value > 0.0 && std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  };
  for (const std::vector<Found>* found : {&outcome.device, &outcome.float64})
    for (const Found& one : *found) look(one.value), first = std::min(first, one.at), last = std::max(last, one.at);
  for (const std::optional<double>& bound : {hard.device_bound, hard.float64_bound})
    if (bound) look(*bound);
  if (last < first) return "";
  if (high == 0.0) low = 1e-1, high = 1.0;
  const double floor = std::floor(std::log10(low)) - 1.0, top = std::ceil(std::log10(high)) + 0.5;
  const bool log_x = first > 0.0 && last / first > 50.0;
  const auto x_value = [&](double at) { return log_x ? std::log10(at) : at; };
  const double width = std::max(x_value(last) - x_value(first), 1e-12);
  const auto x = [&](double at) { return kLeft + (x_value(at) - x_value(first)) / width * (kWidth - kLeft - kRight); };
  const auto y = [&](double value) {
    const double power = value > 0.0 ? std::clamp(std::log10(value), floor, top) : floor;
    return kTop + (top - power) / (top - floor) * (kHeight - kTop - kBottom);
  };
  char text[256];
  std::string svg = "<svg viewBox=\"0 0 330 130\" width=\"330\" height=\"130\" font-size=\"9\">";
  const auto line = [&](double bound, const char* colour) {
    std::snprintf(text, sizeof text,
                  "<line x1=\"%g\" x2=\"%g\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-dasharray=\"4 3\"/>"
                  "<text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%.3g</text>",
                  kLeft, kWidth - kRight, y(bound), y(bound), colour, kLeft - 4, y(bound) + 3, bound);
    svg += text;
  };
  const auto points = [&](const std::vector<Found>& found, const char* colour) {
    for (const Found& one : found) {
      std::snprintf(text, sizeof text, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2\" fill=\"%s\"/>", x(one.at), y(one.value),
                    colour);
      svg += text;
    }
  };
  std::snprintf(text, sizeof text, "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"#ccd\"/>",
                kLeft, kTop, kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  svg += text;
  if (hard.device_bound) line(*hard.device_bound, "#c33");
  if (hard.float64_bound) line(*hard.float64_bound, "#999");
  points(outcome.float64, "#999");
  points(outcome.device, "#06a");
  std::snprintf(text, sizeof text,
                "<text x=\"%g\" y=\"%g\">%.3g</text><text x=\"%g\" y=\"%g\" text-anchor=\"end\">%.3g</text>"
                "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">%s</text></svg>",
                kLeft, kHeight - 18, first, kWidth - kRight, kHeight - 18, last, 0.5 * (kLeft + kWidth), kHeight - 5,
                hard.along.c_str());
  return svg + text;
}

}  // namespace

HardCase float64_case(const char* group, const char* name, const char* breaks, const char* setup, const char* unit,
                      const char* along, double bound, const char* source, std::function<Outcome(const Bench&)> run) {
  return {.name = name,
          .group = group,
          .breaks = breaks,
          .setup = setup,
          .unit = unit,
          .along = along,
          .float64_bound = bound,
          .source = source,
          .run = std::move(run)};
}

std::optional<double> worst(const std::vector<Found>& found) {
  std::optional<double> most;
  for (const Found& one : found) {
    const double value = std::isfinite(one.value) ? one.value : HUGE_VAL;
    most = std::max(most.value_or(value), value);
  }
  return most;
}

Standing standing(const HardCase& hard, const Outcome& outcome) {
  if (!outcome.error.empty()) return Standing::kMissed;
  if (outcome.device.empty() && outcome.float64.empty()) return Standing::kNotRun;
  // A build or a machine without a device still judges the CPU's part.
  const bool device = (outcome.device.empty() && hard.float64_bound) || within(hard.device_bound, outcome.device);
  return device && within(hard.float64_bound, outcome.float64) ? Standing::kHeld : Standing::kMissed;
}

std::string markdown(const std::vector<HardCase>& cases) {
  std::string text =
      "# Hard cases\n\nAfter this page you know where programs of this kind break, and can see on your own machine "
      "that this one does not:\n\n"
      "    ./phare hard-cases                     # all, about a minute\n"
      "    ./phare hard-cases grazing-incidence   # one\n"
      "    ./phare hard-cases --out hard          # and a page with a plot of each\n\n"
      "Exit code 1 if one misses its number; the line that repeats it alone is printed. *Device* is the shader that "
      "draws the frame, *float64* "
      "the processor; both against a closed form where there is one. The list is printed by `./phare hard-cases "
      "--markdown`.\n";
  std::string group;
  for (const HardCase& hard : cases) {
    if (hard.group != group) {
      group = hard.group;
      text += "\n## " + group +
              "\n\n| case | what breaks elsewhere | set-up | at most | device | float64 | why that number |\n"
              "| --- | --- | --- | --- | ---: | ---: | --- |\n";
    }
    text += "| `" + hard.name + "` | " + hard.breaks + " | " + hard.setup + " | " + hard.unit + " | " +
            bound_text(hard.device_bound) + " | " + bound_text(hard.float64_bound) + " | " + hard.source + " |\n";
  }
  return text +
         "\n## Held by tests\n\nThese take processes, sockets or hours, and run in `./phare test`:\n\n"
         "- the car: seventeen cases from standing on a slope to a spin, over more steps, integrators and hours than "
         "above, `HardCase.*` of `phare_dynamics_models_test` ([dynamics.md](dynamics.md)); a day of simulated time "
         "with `PHARE_LONG_TESTS=1`\n"
         "- `lost-device`, `lost-surface` and `minimised-window` with validation on, over more frames, and what the "
         "screen shows read from it: 0 messages; and a command that draws without a launcher, whose device is lost, "
         "says so and ends with 1. `DriveTest.ALostDevice…`, `…ACommandWhoseDeviceIsLost…`, `WindowFault*` of "
         "`phare_process_test`\n"
         "- the bus with sockets and whole processes: the same storm, a stop of 60 s, kills, a flood, a day in "
         "lockstep "
         "([robustness.md](robustness.md))\n"
         "- shadows at a centimetre from their edge, and over a crest: `Shadows.*` of `phare_renderer_test`\n";
}

std::string page(const std::vector<HardCase>& cases, const std::vector<Outcome>& outcomes, const std::string& about) {
  std::string html =
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Hard cases</title><style>body{margin:0 "
      "auto;max-width:1000px;"
      "padding:24px;font:15px/1.5 system-ui,sans-serif;color:#1b2430}section{display:grid;grid-template-columns:1fr "
      "340px;gap:16px;"
      "border-top:1px solid #dde3ea;padding:12px 0}h3{margin:0;font-size:16px}p{margin:4px "
      "0;color:#4a5666}.held{color:#0a7a35}"
      ".missed{color:#c00}.not{color:#888}</style>\n<h1>Hard cases</h1><p>" +
      about + "</p><p>Blue: the device; grey: float64; dashed: the most that is allowed.</p>\n";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Standing found = standing(cases[i], outcomes[i]);
    const char* word = found == Standing::kHeld ? "held" : found == Standing::kMissed ? "missed" : "not run";
    html += "<section><div><h3>" + cases[i].name + " <span class=\"" +
            std::string(word).substr(0, std::string(word).find(' ')) + "\">" + word +
            "</span></h3><p>Elsewhere: " + cases[i].breaks + ".</p><p>" + cases[i].setup + ". " + cases[i].source +
            ".</p><p>";
    if (const auto most = worst(outcomes[i].device)) html += "device " + number(*most) + " ";
    if (const auto most = worst(outcomes[i].float64)) html += "float64 " + number(*most) + " ";
    html += cases[i].unit + outcomes[i].error + "</p></div><div>" + plot(cases[i], outcomes[i]) + "</div></section>\n";
  }
  return html + "</html>\n";
}

}  // namespace phare::hard
