#pragma once

#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

namespace bdpt::test {

/// `part` is the region `crop` of `whole`.
inline void check_region(const Image& part, const Image& whole, const PixelRect& crop)
{
    REQUIRE(part.width == crop.width());
    REQUIRE(part.height == crop.height());
    int different = 0;
    for (int y = crop.y0; y < crop.y1; ++y) {
        for (int x = crop.x0; x < crop.x1; ++x) {
            different += part.at(x - crop.x0, y - crop.y0) == whole.at(x, y) ? 0 : 1;
        }
    }
    CHECK(different == 0);
}

/// `whole`, by one thread, has the bits of any threads, tiles, parts and crops. `options` are its
/// own: six samples and at least 24 x 20 pixels, seen by `room_camera`.
inline void check_purity(const Scene& scene, const RenderOptions& options,
                         const RenderResult& whole)
{
    const auto image_of = [&scene](const RenderOptions& o) {
        return render(scene, room_camera(), o);
    };
    RenderOptions other = options;
    other.system.threads = 8;
    other.system.tile_size = 5;
    const RenderResult again = image_of(other);
    CHECK(again.film == whole.film);
    CHECK(again.stats == whole.stats);

    other = options;
    other.sampling.samples = {.begin = 2, .end = 6};
    Film parts = image_of(other).film;
    other.sampling.samples = {.begin = 0, .end = 2};
    parts.merge(image_of(other).film);
    CHECK(parts == whole.film);

    other = chosen_options(scene, room_camera(), options);  // auto may choose otherwise for a crop
    other.film.crop = PixelRect{5, 3, 24, 20};
    check_region(image_of(other).film.develop(), whole.film.develop(), *other.film.crop);
}

}  // namespace bdpt::test
