#pragma once

#include "gltf_fixture.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::io {

/// A PNG chunk with its length and checksum.
[[nodiscard]] std::string png_chunk(const std::string& type, const std::string& data);

/// A PNG image [PNG specification, 3rd ed.], not compressed. `color_type` 0: grey, 2: RGB, 3:
/// palette, 4: grey and alpha, 6: RGBA; `rows` are as in the file, without the filter byte; `extra`
/// are chunks before the pixels.
[[nodiscard]] std::string png(int width, int height, int depth, int color_type,
                              const std::vector<std::string>& rows, const std::string& extra = "");

/// Bytes from numbers.
[[nodiscard]] std::string raw(const std::vector<int>& values);

/// 8 x 8 pixels of about (255, 127, 0).
[[nodiscard]] std::string orange_jpeg();
/// 2 x 2 pixels of about (255, 0, 0).
[[nodiscard]] std::string red_webp();
/// 1 x 1 pixel of (200, 100, 50) with an alpha of 128.
[[nodiscard]] std::string half_webp();

/// Adds six one-pixel images, whose grey level tells them apart, and a texture of each.
void add_grey_textures(GltfFixture& fixture);
/// Which of these images a reference leads to; -1: none.
[[nodiscard]] int grey_image(const LoadedScene& loaded, const std::optional<TextureRef>& ref);

}  // namespace bdpt::io
