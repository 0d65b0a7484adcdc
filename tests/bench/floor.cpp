#include "tests/bench/floor.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phare::bench {
namespace {

constexpr int kRight = 1024, kUp = 512;  // texels of the plane of tangents
constexpr float kLampHeight_m = 0.65f, kEyeHeight_m = 1.2f, kEyeBehind_m = 1.5f, kEyeY_m = -1.64f;
constexpr float kLampY_m[2] = {-1.4f, -2.6f};
constexpr float kHalfTangent = 0.57735027f;  // 60° across
constexpr float kRoadHalfWidth_m = 4.0f, kExposure = 0.6f;
constexpr float kGroundLambert = 0.15f / std::numbers::pi_v<float>, kRoadLambert = 0.10f / std::numbers::pi_v<float>;

using V = __m256;
#define PHARE_TARGET __attribute__((target("avx2,fma"), always_inline))
#define PHARE_AVX2 PHARE_TARGET inline

PHARE_AVX2 V all(float value) {
  return _mm256_set1_ps(value);
}

// Bilinear in the plane of tangents; texel centres at whole coordinates, edges held.
PHARE_AVX2 V looked_up(const float* table, V column, V row) {
  column = _mm256_min_ps(_mm256_max_ps(column, all(0.0f)), all(kRight - 1.0001f));
  row = _mm256_min_ps(_mm256_max_ps(row, all(0.0f)), all(kUp - 1.0001f));
  const V whole_column = _mm256_floor_ps(column), whole_row = _mm256_floor_ps(row);
  const __m256i at = _mm256_cvttps_epi32(_mm256_fmadd_ps(whole_row, all(static_cast<float>(kRight)), whole_column));
  const V s = _mm256_sub_ps(column, whole_column), t = _mm256_sub_ps(row, whole_row);
  const V low_left = _mm256_i32gather_ps(table, at, 4), low_right = _mm256_i32gather_ps(table + 1, at, 4);
  const V high_left = _mm256_i32gather_ps(table + kRight, at, 4);
  const V high_right = _mm256_i32gather_ps(table + kRight + 1, at, 4);
  const V low = _mm256_fmadd_ps(s, _mm256_sub_ps(low_right, low_left), low_left);
  const V high = _mm256_fmadd_ps(s, _mm256_sub_ps(high_right, high_left), high_left);
  return _mm256_fmadd_ps(t, _mm256_sub_ps(high, low), low);
}

// 1/sqrt to float32 by one step of Newton's.
PHARE_AVX2 V inverse_root(V x) {
  const V guess = _mm256_rsqrt_ps(x);
  return _mm256_mul_ps(guess, _mm256_fnmadd_ps(_mm256_mul_ps(all(0.5f), x), _mm256_mul_ps(guess, guess), all(1.5f)));
}

}  // namespace

Floor::Floor(const IntensityTable& beam, int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      tangents_cd_(kRight * kUp),
      rgba_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
  for (int row = 0; row < kUp; ++row)
    for (int column = 0; column < kRight; ++column) {
      const glm::dvec3 forward_left_up(1.0, -((column + 0.5) / kRight * 2.0 - 1.0), (row + 0.5) / kUp - 0.5);
      tangents_cd_[static_cast<std::size_t>(row * kRight + column)] =
          static_cast<float>(beam.intensity_cd(forward_left_up));
    }
}

bool Floor::possible() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

__attribute__((target("avx2,fma"))) void Floor::draw_row(float x_m, int row, float* lx) {
  const auto w = static_cast<float>(width_px_), h = static_cast<float>(height_px_);
  // The camera is a general one, as a renderer's is: direction = forward + s·right + t·up, here along the axes.
  const float forward[3] = {1.0f, 0.0f, 0.0f}, right[3] = {0.0f, -1.0f, 0.0f}, up[3] = {0.0f, 0.0f, 1.0f};
  const float t = (1.0f - 2.0f * (static_cast<float>(row) + 0.5f) / h) * kHalfTangent * h / w;
  const V lane = _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
  const V eye_x = all(x_m - kEyeBehind_m), eye_y = all(kEyeY_m);
  for (int column = 0; column < width_px_; column += 8) {
    const V s = _mm256_fmadd_ps(_mm256_add_ps(lane, all(static_cast<float>(column) + 0.5f)),
                                all(2.0f * kHalfTangent / w), all(-kHalfTangent));
    const auto direction = [&](int axis) PHARE_TARGET {
      return _mm256_fmadd_ps(s, all(right[axis]), all(forward[axis] + t * up[axis]));
    };
    const V dz = direction(2);
    const V below = _mm256_cmp_ps(dz, all(-1e-6f), _CMP_LT_OQ);
    V sum_lx = all(0.0f), luminance = all(0.0f);
    if (_mm256_movemask_ps(below) != 0) {
      const V way = _mm256_div_ps(all(-kEyeHeight_m), dz);
      const V x = _mm256_fmadd_ps(way, direction(0), eye_x), y = _mm256_fmadd_ps(way, direction(1), eye_y);
      const V ahead = _mm256_sub_ps(x, all(x_m));  // of the lamps
      for (const float lamp_y_m : kLampY_m) {
        const V left = _mm256_sub_ps(y, all(lamp_y_m));
        const V r2 = _mm256_fmadd_ps(ahead, ahead, _mm256_fmadd_ps(left, left, all(kLampHeight_m * kLampHeight_m)));
        const V inverse = inverse_root(r2), inverse_ahead = _mm256_div_ps(all(1.0f), ahead);
        const V at_right =
            _mm256_fmadd_ps(_mm256_mul_ps(left, inverse_ahead), all(-0.5f * kRight), all(0.5f * kRight - 0.5f));
        const V at_up = _mm256_fmadd_ps(all(-kLampHeight_m * kUp), inverse_ahead, all(0.5f * kUp - 0.5f));
        const V candela = _mm256_and_ps(looked_up(tangents_cd_.data(), at_right, at_up),
                                        _mm256_cmp_ps(ahead, all(1e-3f), _CMP_GT_OQ));
        // cos(q)/r² with the lamp h above the plane: h/r³.
        const V geometry = _mm256_mul_ps(_mm256_mul_ps(inverse, inverse), _mm256_mul_ps(inverse, all(kLampHeight_m)));
        sum_lx = _mm256_fmadd_ps(candela, geometry, sum_lx);
      }
      const V aside = _mm256_andnot_ps(all(-0.0f), y);
      const V albedo = _mm256_blendv_ps(all(kGroundLambert), all(kRoadLambert),
                                        _mm256_cmp_ps(aside, all(kRoadHalfWidth_m), _CMP_LT_OQ));
      sum_lx = _mm256_and_ps(sum_lx, below);
      luminance = _mm256_mul_ps(albedo, sum_lx);
    }
    if (lx != nullptr) _mm256_storeu_ps(lx + column, sum_lx);
    const V exposed = _mm256_mul_ps(luminance, all(kExposure));
    const V shown = _mm256_sqrt_ps(_mm256_div_ps(exposed, _mm256_add_ps(exposed, all(1.0f))));
    const __m256i grey = _mm256_cvtps_epi32(_mm256_mul_ps(shown, all(255.0f)));
    const __m256i pixels = _mm256_or_si256(_mm256_mullo_epi32(grey, _mm256_set1_epi32(0x010101)),
                                           _mm256_set1_epi32(static_cast<int>(0xff000000u)));
    std::uint32_t* out = &rgba_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px_)] + column;
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), pixels);
  }
}

void Floor::draw(float x_m) {
#pragma omp parallel for schedule(dynamic, 8)
  for (int row = 0; row < height_px_; ++row) draw_row(x_m, row, nullptr);
}

std::vector<float> Floor::illuminance_lx(float x_m, int row) {
  std::vector<float> lx(static_cast<std::size_t>(width_px_));
  draw_row(x_m, row, lx.data());
  return lx;
}

}  // namespace phare::bench
