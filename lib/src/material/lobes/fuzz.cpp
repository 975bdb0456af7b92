#include "material/lobes/fuzz.h"

#include "math/elementary.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

[[nodiscard]] float fuzz_roughness(float roughness)
{
    return std::clamp(roughness, FuzzTable::min_roughness, 1.0f);
}

/// Returns the paper's R, the albedo.
[[nodiscard]] float fuzz_albedo(float x, float y)
{
    constexpr float least = 1e-6f;
    constexpr float per_root_two_pi = 0.3989423f;
    const float s = y * (0.0206607f + 1.58491f * y) / (0.0379424f + y * (1.32227f + y));
    const float m =
        y * (-0.193854f + y * (-1.14885f + y * (1.7932f - 0.95943f * y * y))) / (0.046391f + y);
    const float o =
        y * (0.000654023f + (-0.0207818f + 0.119681f * y) * y) / (1.26264f + y * (-1.92021f + y));
    const float t = (x - m) / s;
    return std::max(least, exp_exact(-0.5f * t * t) * per_root_two_pi / s + o);
}

/// A linearly transformed cosine: the paper's lobe for the cosine x of one direction and the
/// roughness y. The inverse of its transform, in a frame whose x axis is below that direction, has
/// the rows (a 0 b), (0 a 0) and (0 0 1).
struct TransformedCosine {
    TransformedCosine(float x, float y)
        : a((2.58126f * x + 0.813703f * y) * y / (1.0f + 0.310327f * x * x + 2.60994f * x * y)),
          b(std::sqrt(1.0f - x) * (y - 1.0f) * y * y * y /
            (0.0000254053f + 1.71228f * x - 1.71506f * x * y + 1.34174f * y * y))
    {}

    /// Returns the density over the cosine of a direction with height z, horizontal length squared
    /// `level2` and x coordinate `along`.
    [[nodiscard]] float per_cosine(float z, float level2, float along) const
    {
        const float x = a * along + b * z;
        const float length2 = x * x + a * a * (level2 - along * along) + z * z;
        const float ratio = a / length2;
        return inv_pi * ratio * ratio;
    }

    float a;
    float b;
};

/// Twice the product over the sum.
[[nodiscard]] float harmonic_mean(float a, float b)
{
    return a + b > 0.0f ? 2.0f * a * (b / (a + b)) : 0.0f;
}

[[nodiscard]] float horizontal2(Vec3 w)
{
    return std::max(0.0f, 1.0f - w.z * w.z);
}

/// Returns w as far as it goes along the horizontal part of `of`, whose product is `dot`.
[[nodiscard]] float along_horizontal(float dot, float level2_of)
{
    return level2_of > 1e-8f ? dot / std::sqrt(level2_of) : 0.0f;
}

/// The paper's lobes of two directions, without the factors that make a model of them.
struct BothFuzzLobes {
    BothFuzzLobes(Vec3 wo, Vec3 wi, float roughness)
    {
        const float level_dot = wo.x * wi.x + wo.y * wi.y;
        const float level2_o = horizontal2(wo);
        const float level2_i = horizontal2(wi);
        const float per_cos_i =
            TransformedCosine(wo.z, roughness)
                .per_cosine(wi.z, level2_i, along_horizontal(level_dot, level2_o));
        const float per_cos_o =
            TransformedCosine(wi.z, roughness)
                .per_cosine(wo.z, level2_o, along_horizontal(level_dot, level2_i));
        pdf_fwd = per_cos_i * wi.z;
        pdf_rev = per_cos_o * wo.z;
        mean = harmonic_mean(fuzz_albedo(wo.z, roughness) * per_cos_i,
                             fuzz_albedo(wi.z, roughness) * per_cos_o);
    }

    float pdf_fwd;
    float pdf_rev;
    float mean;
};

/// Returns w with a cosine that is at most 1.
[[nodiscard]] Vec3 with_unit_height(Vec3 w)
{
    return {w.x, w.y, std::min(w.z, 1.0f)};
}

}  // namespace

/// Finds the scales s of a row, in which s(o) times the integral of s(i) mean(o, i) cos(i) is the
/// albedo of o: each is replaced by the geometric mean of itself and what would be right.
void FuzzTable::make_row(std::size_t row) const noexcept
{
    constexpr int heights = 48;
    constexpr int azimuths = 24;
    constexpr int iterations = 60;
    constexpr float min_cosine = 1e-4f;
    using Row = std::array<float, cosine_nodes>;
    const float roughness = roughness_of(SpecularAlbedo::Roughness::of_row(row, roughness_nodes));
    Row albedo{};
    std::array<Row, cosine_nodes> integral{};  // coefficients of s at the nodes
    for (std::size_t column = 0; column < cosine_nodes; ++column) {
        const float x = static_cast<float>(column) / (cosine_nodes - 1);
        const float cos_o = std::max(x * x, min_cosine);
        const Vec3 wo{std::sqrt(1.0f - cos_o * cos_o), 0.0f, cos_o};
        albedo[column] = fuzz_albedo(cos_o, roughness);
        for (int i = 0; i < heights; ++i) {
            const float root = (static_cast<float>(i) + 0.5f) / heights;
            const float cos_i = root * root;
            const float sine = std::sqrt(1.0f - cos_i * cos_i);
            float around = 0.0f;
            for (int j = 0; j < azimuths; ++j) {
                const SinCos turn = sin_cos(pi * (static_cast<float>(j) + 0.5f) / azimuths);
                around +=
                    BothFuzzLobes(wo, {sine * turn.cos, sine * turn.sin, cos_i}, roughness).mean;
            }
            // d cos = 2 root d root
            const float weight = around * cos_i * 4.0f * pi * root / (heights * azimuths);
            const NodePosition at = node_position(root * (cosine_nodes - 1), cosine_nodes);
            integral[column][at.node] += weight * (1.0f - at.fraction);
            integral[column][at.node + 1] += weight * at.fraction;
        }
    }
    Row scale;
    scale.fill(1.0f);
    for (int i = 0; i < iterations; ++i) {
        Row next{};
        for (std::size_t column = 0; column < cosine_nodes; ++column) {
            float sum = 0.0f;
            for (std::size_t node = 0; node < cosine_nodes; ++node) {
                sum += integral[column][node] * scale[node];
            }
            next[column] = std::sqrt(scale[column] * albedo[column] / sum);
        }
        scale = next;
    }
    // What interpolation adds must not make fibres reflect more than they keep from the base.
    constexpr float margin = 0.9985f;
    std::transform(scale.begin(), scale.end(), scale.begin(), [](float s) { return margin * s; });
    std::copy(scale.begin(), scale.end(),
              scale_.begin() + static_cast<std::ptrdiff_t>(row * cosine_nodes));
}

float FuzzTable::scale(NodePosition row, float cosine) const noexcept
{
    const NodePosition p = node_position(std::sqrt(cosine) * (cosine_nodes - 1), cosine_nodes);
    const float* lower = scale_.data() + row.node * cosine_nodes + p.node;
    const float* upper = lower + cosine_nodes;
    const float below = lower[0] + p.fraction * (lower[1] - lower[0]);
    const float above = upper[0] + p.fraction * (upper[1] - upper[0]);
    return below + row.fraction * (above - below);
}

FuzzTable::Value FuzzTable::eval(Vec3 wo, Vec3 wi, float roughness) const noexcept
{
    const float used = fuzz_roughness(roughness);
    const NodePosition row = FuzzTable::row(used).position(roughness_nodes);
    rows_.require(row.node, [this](std::size_t made) { make_row(made); });
    const Vec3 o = with_unit_height(wo);
    const Vec3 i = with_unit_height(wi);
    const BothFuzzLobes lobes(o, i, used);
    return {lobes.mean * scale(row, o.z) * scale(row, i.z), lobes.pdf_fwd, lobes.pdf_rev};
}

SpecularAlbedo::Roughness FuzzTable::row(float roughness) noexcept
{
    return SpecularAlbedo::at_roughness((fuzz_roughness(roughness) - min_roughness) /
                                        (1.0f - min_roughness));
}

float FuzzTable::directional(float cosine, float roughness) noexcept
{
    return std::min(1.0f, fuzz_albedo(std::clamp(cosine, 0.0f, 1.0f), fuzz_roughness(roughness)));
}

Vec3 FuzzTable::sample(Vec3 wo, float roughness, Vec2 u) noexcept
{
    const Vec3 o = with_unit_height(wo);
    const TransformedCosine lobe(o.z, fuzz_roughness(roughness));
    const Vec3 before = square_to_cosine_hemisphere(u);
    const Vec3 after = normalize(Vec3{before.x - before.z * lobe.b, before.y, before.z * lobe.a});
    const float level = std::sqrt(horizontal2(o));
    const Vec2 x = level > 1e-4f ? Vec2(o) / std::sqrt(o.x * o.x + o.y * o.y) : Vec2(1.0f, 0.0f);
    return {after.x * x.x - after.y * x.y, after.x * x.y + after.y * x.x, after.z};
}

Fuzz::Fuzz(float weight, Rgb color, float roughness, const FuzzTable* table)
    : color_(color), weight_(table != nullptr ? weight : 0.0f), roughness_(roughness), table_(table)
{}

Rgb Fuzz::color_over(Rgb base) const noexcept
{
    constexpr float typical_cosine = 0.5f;
    const float kept = reflected({0.0f, 0.0f, typical_cosine});
    return kept * color_ + (1.0f - kept) * base;
}

BsdfEval Fuzz::eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
{
    const FuzzTable::Value value = table_->eval(wo, wi, roughness_);
    return {color_ * (weight_ * value.f * wi.z), SolidAnglePdf{value.pdf_fwd},
            SolidAnglePdf{value.pdf_rev}};
}

std::optional<BsdfSample> Fuzz::sample(Vec3 wo, float, Vec2 u, TransportMode) const noexcept
{
    return towards(FuzzTable::sample(wo, roughness_, u));
}

}  // namespace bdpt
