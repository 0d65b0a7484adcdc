// fuzz: the corpus of each decoder, and a slice of new damage; phare-fuzz does the same for as long as wanted.
#include "tests/fuzz/decoders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace phare::test {
namespace {

TEST(FuzzedDecoders, AnswerTheCorpusAndASliceOfDamage) {
  const char* const wanted = std::getenv("PHARE_FUZZ_ROUNDS");
  const auto rounds = static_cast<std::uint64_t>(wanted != nullptr ? std::max(1, std::atoi(wanted)) : 3000);
  for (const FuzzedDecoder& decoder : fuzzed_decoders()) {
    const auto corpus = kept_corpus(decoder.name);
    EXPECT_FALSE(corpus.empty()) << decoder.name;
    for (const std::string& seed : decoder.seeds)
      EXPECT_TRUE(decoder.decode(seed).starts_with("taken")) << decoder.name;
    const FuzzRun run = fuzz(decoder, corpus, rounds, 20261122);
    EXPECT_GT(run.taken, 0u) << decoder.name;
    const bool takes_all = decoder.name == "frames";  // what no control is mapped to is passed over
    EXPECT_EQ(run.taken == run.inputs, takes_all) << decoder.name;
  }
}

TEST(FuzzedDecoders, ACorpusIsReadAsItWasKept) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  EXPECT_EQ(unescaped(escaped(all)), all);
  EXPECT_EQ(escaped("a\\\n"), "a\\x5c\\x0a");
}

}  // namespace
}  // namespace phare::test
