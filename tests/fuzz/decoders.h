// Every decoder of bytes from outside, as one function for a fuzzer: any answer will do, a crash will not. The answer
// is a word for what became of the input; inputs with a new word are the corpus (tests/fuzz/corpus).
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace phare::test {

struct FuzzedDecoder {
  std::string name;
  std::vector<std::string> seeds;  ///< good inputs
  /// Decodes and checks what must hold of any result; aborts where it does not.
  std::function<std::string(const std::string&)> decode;
};

/// datagram, candump, dbc, cockpit, frames.
std::vector<FuzzedDecoder> fuzzed_decoders();

/// Bytes changed, cut, doubled, moved and spliced with another input.
std::string damaged_input(const std::string& good, const std::string& other, std::mt19937_64& random);

/// One input a line: printable bytes as they are, others and the backslash as \xNN.
std::string escaped(const std::string& bytes);
std::string unescaped(const std::string& line);

/// What became of inputs by word; an input is kept when its word is new.
struct FuzzRun {
  std::uint64_t inputs = 0, taken = 0;
  std::vector<std::string> fresh;  ///< inputs with new words, in the order they came
};

/// All inputs of the corpus, then `count` damaged ones. `corpus`: inputs kept before.
FuzzRun fuzz(const FuzzedDecoder& decoder, const std::vector<std::string>& corpus, std::uint64_t count,
             std::uint64_t seed);

/// tests/fuzz/corpus/NAME.txt of this source tree.
std::vector<std::string> kept_corpus(const std::string& name);

}  // namespace phare::test
