// phare-fuzz: as many damaged inputs to each decoder as wanted; what is new is added to the corpus.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>

#include "tests/fuzz/decoders.h"
#include "tests/paths.h"

int main(int argc, char** argv) {
  using namespace phare;
  std::uint64_t inputs = 1'000'000, seed = 1;
  std::string only;
  bool keep = false;
  CLI::App app{"Damaged inputs to every decoder: any answer will do, a crash will not"};
  app.footer("Example:\n  phare-fuzz --inputs 10000000 --keep");
  app.add_option("--inputs", inputs, "Of each decoder")->capture_default_str();
  app.add_option("--seed", seed, "Of the damage")->capture_default_str();
  std::vector<std::string> names;
  for (const test::FuzzedDecoder& decoder : test::fuzzed_decoders()) names.push_back(decoder.name);
  app.add_option("--decoder", only, "One only")->check(CLI::IsMember(names));
  app.add_flag("--keep", keep, "Add inputs that were answered as none before to tests/fuzz/corpus");
  CLI11_PARSE(app, argc, argv);
  for (const test::FuzzedDecoder& decoder : test::fuzzed_decoders()) {
    if (!only.empty() && decoder.name != only) continue;
    const auto corpus = test::kept_corpus(decoder.name);
    const test::FuzzRun run = test::fuzz(decoder, corpus, inputs, seed);
    std::printf("%-9s %llu inputs, %llu taken, corpus %zu, %zu new\n", decoder.name.c_str(),
                static_cast<unsigned long long>(run.inputs), static_cast<unsigned long long>(run.taken), corpus.size(),
                run.fresh.size());
    std::fflush(stdout);
    if (!keep) continue;
    std::ofstream file(tests_dir("fuzz") + "/corpus/" + decoder.name + ".txt", std::ios::app);
    for (const std::string& input : run.fresh) file << test::escaped(input) << '\n';
  }
  return 0;
}
