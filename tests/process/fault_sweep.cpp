// phare-fault-sweep: the long form of tests/process/fault_test.cpp. Kills, stops and both together at random times, in
// real time and in lockstep, by a seed; says how many pictures showed a beam that neither stalk nor fail-safe asked
// for.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "tests/process/drive_run.h"
#include "tests/process/faults.h"

int main(int argc, char** argv) {
  using namespace phare::test;
  int faults = 200, each = 20;
  std::uint64_t seed = 1;
  std::string kind = "all", time = "both";
  CLI::App app{"Drives with faults at random times, and what every picture showed meanwhile"};
  app.add_option("--faults", faults, "Of each kind, in real time and in lockstep")->capture_default_str();
  app.add_option("--each", each, "Faults in one drive")->capture_default_str();
  app.add_option("--seed", seed, "Of the first drive; it counts on")->capture_default_str();
  app.add_option("--kind", kind, "kill, stop, both or all")->check(CLI::IsMember({"kill", "stop", "both", "all"}));
  app.add_option("--time", time, "real, lockstep or both")->check(CLI::IsMember({"real", "lockstep", "both"}));
  CLI11_PARSE(app, argc, argv);

  bool good = true;
  std::printf("%-5s %-9s %6s %6s %6s %9s %9s %9s %6s %6s\n", "kind", "time", "drives", "kills", "stops", "restarts",
              "pictures", "fail-safe", "wrong", "lost");
  const char* const names[] = {"kill", "stop", "both"};
  for (int k = 0; k < 3; ++k) {
    if (kind != "all" && kind != names[k]) continue;
    for (const bool lockstep : {false, true}) {
      if (time != "both" && (time == "lockstep") != lockstep) continue;
      FaultResult sum;
      int drives = 0, lost = 0;
      for (int done = 0; done < faults; done += each, ++drives) {
        const phare::TemporaryFolder folder;
        const FaultResult one = drive_with_faults({.kind = static_cast<FaultSetup::Kind>(k),
                                                   .lockstep = lockstep,
                                                   .faults = std::min(each, faults - done),
                                                   .seed = seed + static_cast<std::uint64_t>(drives)},
                                                  folder.path());
        const bool is_lost = one.exit_code != 0 || one.driven_s < one.log_s - 1.0;
        lost += is_lost ? 1 : 0;
        if (is_lost || one.wrong > 0 || one.restarts_reported < one.kills || one.time_back > 0)
          std::printf("# seed %llu: exit %d, %.1f of %.1f s, %d kills, %d restarts told, time back %llu times\n",
                      static_cast<unsigned long long>(seed + static_cast<std::uint64_t>(drives)), one.exit_code,
                      one.driven_s, one.log_s, one.kills, one.restarts_reported,
                      static_cast<unsigned long long>(one.time_back));
        for (const std::string& text : one.wrong_ones) std::printf("# wrong at %s\n", text.c_str());
        sum.kills += one.kills, sum.stops += one.stops, sum.restarts_reported += one.restarts_reported;
        sum.pictures += one.pictures, sum.fail_safe += one.fail_safe, sum.wrong += one.wrong;
      }
      std::printf("%-5s %-9s %6d %6d %6d %9d %9llu %9llu %6llu %6d\n", names[k], lockstep ? "lockstep" : "real time",
                  drives, sum.kills, sum.stops, sum.restarts_reported, static_cast<unsigned long long>(sum.pictures),
                  static_cast<unsigned long long>(sum.fail_safe), static_cast<unsigned long long>(sum.wrong), lost);
      std::fflush(stdout);
      good = good && sum.wrong == 0 && lost == 0;
    }
  }
  return good ? 0 : 1;
}
