// libFuzzer target of all photometry readers: cmake -DPHARE_FUZZ=ON with clang, then
//   phare_photometry_fuzz -rss_limit_mb=512 -timeout=5 CORPUS
// The first byte chooses the format, the rest is the file.
#include <cstddef>
#include <cstdint>

#include "visual/photometry/bench/lint.h"
#include "visual/photometry/readers/read_lamp.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  phare::LampReadSettings settings;
  settings.format = static_cast<phare::LampFormat>(data[0] % 5);
  settings.mirror_h = (data[0] & 8) != 0;
  settings.axis = (data[0] & 16) != 0 ? phare::GammaAxis::kGamma90 : phare::GammaAxis::kGamma0;
  const auto table = phare::parse_lamp({reinterpret_cast<const char*>(data) + 1, size - 1}, "fuzz", settings);
  if (table.ok()) (void)phare::lint_lamp(*table);
  return 0;
}
