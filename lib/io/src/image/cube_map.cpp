#include "image/cube_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::io {

namespace {

/// Point of the cube in a direction: 0 to 1 from left to right and from top to bottom.
struct FacePoint {
    std::size_t face = 0;
    float right = 0.0f;
    float down = 0.0f;
};

FacePoint face_point(const Vec3& d)
{
    const Vec3 size(std::abs(d.x), std::abs(d.y), std::abs(d.z));
    const auto point = [](std::size_t face, float right, float down, float major) {
        return FacePoint{face, 0.5f + 0.5f * right / major, 0.5f + 0.5f * down / major};
    };
    if (size.x >= size.y && size.x >= size.z) {
        return d.x > 0.0f ? point(0, d.z, -d.y, size.x) : point(1, -d.z, -d.y, size.x);
    }
    if (size.y >= size.z) {
        return d.y > 0.0f ? point(2, -d.x, d.z, size.y) : point(3, -d.x, -d.z, size.y);
    }
    return d.z > 0.0f ? point(4, -d.x, -d.y, size.z) : point(5, d.x, -d.y, size.z);
}

/// Interpolates between the centres of the four surrounding texels; clamped beyond the outermost
/// ones.
Rgb bilinear(const Image& image, float u, float v)
{
    const float x = std::clamp(u * static_cast<float>(image.width) - 0.5f, 0.0f,
                               static_cast<float>(image.width - 1));
    const float y = std::clamp(v * static_cast<float>(image.height) - 0.5f, 0.0f,
                               static_cast<float>(image.height - 1));
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, image.width - 1);
    const int y1 = std::min(y0 + 1, image.height - 1);
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    return (1.0f - fy) * ((1.0f - fx) * image.at(x0, y0) + fx * image.at(x1, y0)) +
           fy * ((1.0f - fx) * image.at(x0, y1) + fx * image.at(x1, y1));
}

Image halved(const Image& image)
{
    Image half{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
    half.pixels.reserve(image.pixels.size() / 4 + 1);
    for (int y = 0; y < half.height; ++y) {
        const int y1 = std::min(2 * y + 1, image.height - 1);
        for (int x = 0; x < half.width; ++x) {
            const int x1 = std::min(2 * x + 1, image.width - 1);
            half.pixels.push_back(0.25f * (image.at(2 * x, 2 * y) + image.at(x1, 2 * y) +
                                           image.at(2 * x, y1) + image.at(x1, y1)));
        }
    }
    return half;
}

}  // namespace

CubeMap halved(const CubeMap& cube)
{
    CubeMap half;
    std::transform(cube.faces.begin(), cube.faces.end(), half.faces.begin(),
                   [](const Image& face) { return halved(face); });
    return half;
}

Rgb CubeMap::lookup(const Vec3& direction) const
{
    const FacePoint point = face_point(direction);
    return bilinear(faces[point.face], point.right, point.down);
}

Image to_equirectangular(const CubeMap& cube, int height)
{
    // Sixteen lookups per texel: enough even at the corners of faces, where texels look small.
    constexpr int parts = 4;
    const int width = 2 * height;
    std::vector<CirclePoint> azimuths;
    for (int i = 0; i < parts * width; ++i) {
        azimuths.push_back(circle_point((i + 0.5) / (parts * width) - 0.5));
    }
    Image image{width, height, {}};
    image.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        std::array<CirclePoint, parts> polar;
        double weights = 0.0;
        for (int i = 0; i < parts; ++i) {
            auto& point = polar[static_cast<std::size_t>(i)];
            point = circle_point(0.5 * (y * parts + i + 0.5) / (parts * height));
            weights += parts * point.sin;
        }
        for (int x = 0; x < width; ++x) {
            Rgb sum(0.0f);
            for (int i = 0; i < parts * parts; ++i) {
                const CirclePoint& phi = azimuths[static_cast<std::size_t>(x * parts + i % parts)];
                const CirclePoint& theta = polar[static_cast<std::size_t>(i / parts)];
                const Vec3 direction(theta.sin * phi.sin, theta.cos, -theta.sin * phi.cos);
                sum += static_cast<float>(theta.sin / weights) * cube.lookup(direction);
            }
            image.pixels.push_back(sum);
        }
    }
    return image;
}

}  // namespace bdpt::io
