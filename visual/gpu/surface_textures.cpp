#include "visual/gpu/surface_textures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>

#include "visual/scene/relief.h"

namespace phare {
namespace {

/// Seen along a road texels are long: so many samples along them, where the device has it. Chosen: 4 keeps a lane's
/// markings apart to 60 m; a software device pays for each.
constexpr float kAnisotropy = 4.0f;

const std::array<vk::DescriptorSetLayoutBinding, 4> kTextureBindings{
    vk::DescriptorSetLayoutBinding{.binding = 0,
                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eFragment},
    vk::DescriptorSetLayoutBinding{.binding = 1,
                                   .descriptorType = vk::DescriptorType::eUniformBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eFragment},
    // Of a relief; what has none names its own image there, for lavapipe reads all of a set, and no shader reads it.
    vk::DescriptorSetLayoutBinding{.binding = 2,
                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eFragment},
    vk::DescriptorSetLayoutBinding{.binding = 3,
                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eFragment}};

vk::SamplerAddressMode address_of(TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::kMirror:
      return vk::SamplerAddressMode::eMirroredRepeat;
    case TextureWrap::kClamp:
      return vk::SamplerAddressMode::eClampToEdge;
    case TextureWrap::kRepeat:
      break;
  }
  return vk::SamplerAddressMode::eRepeat;
}

/// `most_anisotropy`: samples along what is seen at a slant.
vk::raii::Sampler make_sampler(const gpu::Device& device, const TextureSampler& sampler, float most_anisotropy) {
  const vk::Filter near = sampler.nearest ? vk::Filter::eNearest : vk::Filter::eLinear;
  const float anisotropy = std::min(most_anisotropy, device.most_anisotropy);
  return vk::raii::Sampler(device.device, vk::SamplerCreateInfo{.magFilter = near,
                                                                .minFilter = vk::Filter::eLinear,
                                                                .mipmapMode = vk::SamplerMipmapMode::eLinear,
                                                                .addressModeU = address_of(sampler.across),
                                                                .addressModeV = address_of(sampler.down),
                                                                .anisotropyEnable = !sampler.nearest && anisotropy > 1,
                                                                .maxAnisotropy = anisotropy,
                                                                .maxLod = VK_LOD_CLAMP_NONE});
}

/// So much of a picture is there.
double share_from(const SceneTexture& texture, float opacity) {
  std::size_t there = 0;
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    there += static_cast<float>(texture.rgba[i]) >= 255.0f * opacity ? 1u : 0u;
  return static_cast<double>(there) / (static_cast<double>(texture.rgba.size()) / 4.0);
}

/// Averaged opacity falls below the limit where things are thin, and leaves would vanish far away: raised so that as
/// much is there as in the whole picture (Castaño 2010).
void keep_share(SceneTexture& texture, double share, float cut_below) {
  std::array<std::size_t, 256> count{};
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4) ++count[texture.rgba[i]];
  const double texels = static_cast<double>(texture.rgba.size()) / 4.0;
  std::size_t limit = 255;
  for (double there = static_cast<double>(count[255]); limit > 1 && there / texels < share;)
    there += static_cast<double>(count[--limit]);
  const float scale = 255.0f * cut_below / static_cast<float>(limit);
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    texture.rgba[i] = static_cast<std::uint8_t>(
        std::clamp(std::lround(std::ceil(static_cast<float>(texture.rgba[i]) * scale)), 0l, 255l));
}

/// Layers of one size, as large as the largest, and each of their levels of detail.
std::vector<std::vector<SceneTexture>> levels_of(const Scene& scene, const PixelLook& look) {
  std::vector<const SceneTexture*> layers;
  static const SceneTexture white{"white", 1, 1, {255, 255, 255, 255}};
  layers.push_back(look.base_texture ? &scene.textures[*look.base_texture] : &white);
  const bool emits = look.emissive_texture && !look.unlit;
  layers.push_back(emits ? &scene.textures[*look.emissive_texture] : &white);
  std::uint32_t width = 1, height = 1;
  for (const SceneTexture* layer : layers) {
    width = std::max(width, layer->width);
    height = std::max(height, layer->height);
  }
  std::vector<std::vector<SceneTexture>> all;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const SceneTexture& layer = *layers[i];
    std::vector<SceneTexture>& levels = all.emplace_back();
    levels.push_back(layer.width == width && layer.height == height ? layer : resized(layer, width, height));
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
    if (i != 0 || !look.cut_below) continue;
    const double share = share_from(levels.front(), *look.cut_below);
    for (std::size_t level = 1; level < levels.size(); ++level) keep_share(levels[level], share, *look.cut_below);
  }
  return all;
}

/// A level of detail of one layer, as its format has it.
struct Texels {
  std::uint32_t width, height;
  std::span<const std::byte> bytes;
};

gpu::Image make_image(gpu::Device& device, const std::vector<std::vector<Texels>>& layers, vk::Format format,
                      const std::string& name) {
  const std::vector<Texels>& first = layers.front();
  const auto mips = static_cast<std::uint32_t>(first.size()), count = static_cast<std::uint32_t>(layers.size());
  gpu::Image image(device,
                   {format,
                    {first[0].width, first[0].height},
                    vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
                    vk::SampleCountFlagBits::e1,
                    count,
                    mips},
                   "texture " + name);
  image.memory = device.allocate(image.image.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
  image.bind(device, *image.memory);
  std::vector<std::byte> texels;
  std::vector<vk::BufferImageCopy> copies;
  for (std::uint32_t layer = 0; layer < count; ++layer)
    for (std::uint32_t mip = 0; mip < mips; ++mip) {
      const Texels& level = layers[layer][mip];
      copies.push_back({.bufferOffset = texels.size(),
                        .imageSubresource = {vk::ImageAspectFlagBits::eColor, mip, layer, 1},
                        .imageExtent = {level.width, level.height, 1}});
      texels.insert(texels.end(), level.bytes.begin(), level.bytes.end());
    }
  const gpu::HostBuffer staging(device, texels.size(), vk::BufferUsageFlagBits::eTransferSrc, "texture staging");
  std::memcpy(staging.data, texels.data(), texels.size());
  device.run_once(
      [&](vk::CommandBuffer commands) { gpu::record_fill(commands, image, *staging.buffer, copies); });
  return image;
}

std::vector<Texels> texels_of(const std::vector<SceneTexture>& levels) {
  std::vector<Texels> texels;
  for (const SceneTexture& level : levels)
    texels.push_back({level.width, level.height, std::as_bytes(std::span(level.rgba))});
  return texels;
}

std::vector<Texels> texels_of(const std::vector<NormalLevel>& levels) {
  std::vector<Texels> texels;
  for (const NormalLevel& level : levels)
    texels.push_back({level.width, level.height, std::as_bytes(std::span(level.texels))});
  return texels;
}

}  // namespace

std::uint32_t look_bits(const SceneMaterial& material) {
  const PixelLook& look = material.look;
  if (look.none()) return 0;
  std::uint32_t bits = 0;
  if (look.base_texture) bits |= shader::kLookBase;
  if (look.cut_below) bits |= shader::kLookCut;
  if (look.corner_colours) bits |= shader::kLookColours;
  if (look.emitted_cdm2 != glm::vec3(0.0f)) bits |= shader::kLookEmits;
  if (look.emissive_texture && !look.unlit) bits |= shader::kLookEmissive;
  if (look.unlit) bits |= shader::kLookUnlit;
  if (look.normal_texture) bits |= shader::kLookNormal;
  if (look.rough_texture) bits |= shader::kLookRough;
  return bits;
}

const char* no_textures(const gpu::Device& device) {
  const vk::PhysicalDeviceLimits& limits = device.properties.limits;
  // Behind eight lamps and fixed light there are 17 locations before their three; the method "reference" has four sets
  // before theirs.
  if (std::min(limits.maxVertexOutputComponents, limits.maxFragmentInputComponents) < 80)
    return "it hands fewer than 80 numbers from corner to pixel";
  return limits.maxBoundDescriptorSets < 5 ? "it binds fewer than 5 descriptor sets" : nullptr;
}

SurfaceTextures::SurfaceTextures(gpu::Device& device, std::span<const Scene* const> scenes) {
  struct Entry {
    std::size_t material = 0, image = 0, sampler = 0;
    std::optional<std::size_t> normals{}, rough{}, level_sampler{};
  };
  std::vector<Entry> entries;
  std::vector<TextureSampler> samplers, level_samplers;
  using Key = std::tuple<std::size_t, std::optional<std::size_t>, std::optional<std::size_t>, std::optional<float>>;
  std::map<Key, std::size_t> known;  // several materials may share their pictures
  std::map<std::tuple<std::size_t, std::size_t, float, bool>, std::size_t> known_normals;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known_rough;
  std::vector<std::byte> looks;
  bool reliefs = false;
  for (const Scene* scene : scenes)
    reliefs = reliefs || std::ranges::any_of(scene->materials, [](const auto& m) { return m.look.relief(); });
  constexpr std::size_t kWithRelief = sizeof(shader::GpuLook) + sizeof(shader::GpuRelief);
  const std::size_t align = device.properties.limits.minUniformBufferOffsetAlignment;
  const std::size_t step =
      std::max(reliefs ? (kWithRelief + align - 1) / align * align : sizeof(shader::GpuLook), align);
  std::size_t number = 0;
  for (std::size_t s = 0; s < scenes.size(); ++s)
    for (const SceneMaterial& material : scenes[s]->materials) {
      const std::size_t own = number++;
      const PixelLook& look = material.look;
      if (look.none()) continue;
      const std::optional<std::size_t> emissive = look.unlit ? std::nullopt : look.emissive_texture;
      const auto [image, fresh] =
          known.try_emplace({s, look.base_texture, emissive, look.base_texture ? look.cut_below : std::nullopt},
                            images_.size());
      if (fresh) {
        const std::vector<std::vector<SceneTexture>> layers = levels_of(*scenes[s], look);
        std::vector<std::vector<Texels>> texels;
        for (const std::vector<SceneTexture>& layer : layers) texels.push_back(texels_of(layer));
        images_.push_back(make_image(device, texels, vk::Format::eR8G8B8A8Srgb, layers.front().front().name));
      }
      auto sampler = std::ranges::find(samplers, look.sampler);
      if (sampler == samplers.end()) {
        samplers_.push_back(make_sampler(device, look.sampler, kAnisotropy));
        sampler = samplers.insert(samplers.end(), look.sampler);
      }
      Entry entry{own, image->second, static_cast<std::size_t>(sampler - samplers.begin())};
      const shader::GpuRelief relief{glm::vec4(look.roughness, look.metal, 0.0f, 0.0f)};
      const auto image_of = [&](auto& among, const auto& key, vk::Format format, const auto& levels) {
        const auto [found, is_new] = among.try_emplace(key, images_.size());
        if (is_new) {
          const auto all = levels();
          images_.push_back(make_image(device, {texels_of(all)}, format, "of a relief"));
        }
        return found->second;
      };
      if (look.normal_texture)
        entry.normals = image_of(
            known_normals, std::tuple(s, *look.normal_texture, look.normal_scale, look.sampler.nearest),
            vk::Format::eR16G16B16A16Sfloat, [&] {
              return normal_levels(scenes[s]->textures[*look.normal_texture], look.normal_scale, look.sampler.nearest);
            });
      if (look.rough_texture)
        entry.rough = image_of(known_rough, std::pair(s, *look.rough_texture), vk::Format::eR8G8B8A8Unorm,
                               [&] { return rough_levels(scenes[s]->textures[*look.rough_texture]); });
      if (look.relief()) {
        auto level = std::ranges::find(level_samplers, look.sampler);
        if (level == level_samplers.end()) level = level_samplers.insert(level_samplers.end(), look.sampler);
        entry.level_sampler = static_cast<std::size_t>(level - level_samplers.begin());
      }
      const shader::GpuLook packed{look.base, glm::vec4(look.emitted_cdm2, look.cut_below.value_or(0.0f))};
      const std::size_t at = entries.size() * step;
      looks.resize(at + (reliefs ? kWithRelief : sizeof packed));
      std::memcpy(&looks[at], &packed, sizeof packed);
      if (reliefs) std::memcpy(&looks[at + sizeof packed], &relief, sizeof relief);
      entries.push_back(entry);
    }
  if (entries.empty()) return;
  // What a level hides of slopes is known of the level as it is, so a relief is not sampled along a slant.
  const std::size_t first_level_sampler = samplers_.size();
  for (const TextureSampler& sampler : level_samplers) samplers_.push_back(make_sampler(device, sampler, 1.0f));
  looks_ = gpu::DeviceBuffer(device, looks, vk::BufferUsageFlagBits::eUniformBuffer, "looks");
  for (const gpu::Image& image : images_) bytes_ += image.bytes;
  descriptors_ = std::make_unique<gpu::DescriptorSets>(device, kTextureBindings);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const vk::DescriptorSet set = sets_[entries[i].material] = descriptors_->make();
    const vk::DescriptorImageInfo image{*samplers_[entries[i].sampler], *images_[entries[i].image].view,
                                        vk::ImageLayout::eShaderReadOnlyOptimal};
    const vk::DescriptorBufferInfo buffer{*looks_.buffer, i * step, reliefs ? kWithRelief : sizeof(shader::GpuLook)};
    // A relief that has but one of them names that twice: its pipeline reads it once.
    const std::size_t normals = entries[i].normals.value_or(entries[i].rough.value_or(entries[i].image)),
                      rough = entries[i].rough.value_or(normals);
    const std::size_t sampler =
        entries[i].level_sampler ? first_level_sampler + *entries[i].level_sampler : entries[i].sampler;
    const vk::DescriptorImageInfo normal_image{*samplers_[sampler], *images_[normals].view,
                                               vk::ImageLayout::eShaderReadOnlyOptimal};
    const vk::DescriptorImageInfo rough_image{*samplers_[sampler], *images_[rough].view,
                                              vk::ImageLayout::eShaderReadOnlyOptimal};
    std::vector writes{vk::WriteDescriptorSet{.dstSet = set,
                                                   .dstBinding = 0,
                                                   .descriptorCount = 1,
                                                   .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                   .pImageInfo = &image},
                            vk::WriteDescriptorSet{.dstSet = set,
                                                   .dstBinding = 1,
                                                   .descriptorCount = 1,
                                                   .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                   .pBufferInfo = &buffer}};
    for (const auto& [binding, info] : {std::pair(2u, &normal_image), std::pair(3u, &rough_image)})
      writes.push_back({.dstSet = set,
                        .dstBinding = binding,
                        .descriptorCount = 1,
                        .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                        .pImageInfo = info});
    device.device.updateDescriptorSets(writes, nullptr);
  }
}

}  // namespace phare
