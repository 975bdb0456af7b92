#include "material/lobes/sheen.h"

#include "math/elementary.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

/// Minimum cosine of the paper's masking functions: near the horizon its fit grows without bound.
constexpr float min_cosine = 1e-5f;

/// Returns x^y for x > 0.
[[nodiscard]] float power(float x, float y)
{
    return exp_exact(y * log_exact(x));
}

/// Returns the fit of the paper's section 4, interpolated between its two columns.
[[nodiscard]] float fitted(float x, float alpha)
{
    const float share = (1.0f - alpha) * (1.0f - alpha);
    const float a = glm::mix(21.5473f, 25.3245f, share);
    const float b = glm::mix(3.82987f, 3.32435f, share);
    const float c = glm::mix(0.19823f, 0.16801f, share);
    const float d = glm::mix(-1.97760f, -1.27393f, share);
    const float e = glm::mix(-4.32054f, -4.85967f, share);
    return a / (1.0f + b * power(x, c)) + d * x + e;
}

/// Returns Smith's Lambda.
[[nodiscard]] float lambda(float cosine, float alpha)
{
    if (cosine < 0.5f) {
        return exp_exact(fitted(cosine, alpha));
    }
    const float rest = std::max(min_cosine, 1.0f - cosine);
    return exp_exact(2.0f * fitted(0.5f, alpha) - fitted(rest, alpha));
}

/// Returns D(h) of a half vector of any length.
[[nodiscard]] float distribution(Vec3 h, float alpha)
{
    constexpr float min_sine2 = 1e-30f;
    const float sine2 = (h.x * h.x + h.y * h.y) / dot(h, h);
    const float exponent = 1.0f / alpha;
    return (2.0f + exponent) * 0.5f * inv_pi *
           power(std::clamp(sine2, min_sine2, 1.0f), 0.5f * exponent);
}

[[nodiscard]] float to_alpha(float roughness)
{
    const float used = std::clamp(roughness, SheenAlbedo::min_roughness, 1.0f);
    return used * used;
}

/// Integrates the formula times `factor(cos_i)` over all wi, by midpoints of the azimuth over one
/// half of its symmetric range and of the root of the cosine.
template <typename Factor>
[[nodiscard]] float integrate(float cosine, float alpha, const Factor& factor)
{
    constexpr int heights = 40;
    constexpr int azimuths = 24;
    const float cos_o = std::max(cosine, min_cosine);
    const Vec3 wo{std::sqrt(1.0f - cos_o * cos_o), 0.0f, cos_o};
    const float lambda_o = lambda(cos_o, alpha);
    float sum = 0.0f;
    for (int i = 0; i < heights; ++i) {
        const float root = (static_cast<float>(i) + 0.5f) / heights;
        const float cos_i = std::max(root * root, min_cosine);
        const float sine = std::sqrt(1.0f - cos_i * cos_i);
        float around = 0.0f;
        for (int j = 0; j < azimuths; ++j) {
            const SinCos azimuth = sin_cos(pi * (static_cast<float>(j) + 0.5f) / azimuths);
            around += distribution(wo + Vec3{sine * azimuth.cos, sine * azimuth.sin, cos_i}, alpha);
        }
        // d cos = 2 root d root; f cos_i = D / (4 cos_o (1 + Lambda))
        sum += around * 2.0f * root * factor(cos_i) /
               (4.0f * cos_o * (1.0f + lambda_o + lambda(cos_i, alpha)));
    }
    return sum * 2.0f * pi / (heights * azimuths);
}

}  // namespace

SheenAlbedo::SheenAlbedo()
{
    constexpr float between_nodes = 1.002f;  // an albedo may be larger than at its neighbours
    const auto for_each_node = [&](const auto& visit) {
        for (int row = 0; row < roughness_nodes; ++row) {
            const float share = static_cast<float>(row) / (roughness_nodes - 1);
            const float alpha = to_alpha(glm::mix(min_roughness, 1.0f, share));
            for (int column = 0; column < cosine_nodes; ++column) {
                const float x = static_cast<float>(column) / (cosine_nodes - 1);
                visit(row, static_cast<std::size_t>(row * cosine_nodes + column), x * x, alpha);
            }
        }
    };
    for_each_node([&](int row, std::size_t node, float cosine, float alpha) {
        const float albedo = integrate(cosine, alpha, [](float) { return 1.0f; });
        excess_[node] = std::max(1.0f, between_nodes * albedo);
        exceeds_one_[static_cast<std::size_t>(row)] |= excess_[node] > 1.0f;
    });
    for_each_node([&](int row, std::size_t node, float cosine, float alpha) {
        const Rows rows = row + 1 < roughness_nodes ? Rows{row, 0.0f} : Rows{row - 1, 1.0f};
        directional_[node] = integrate(
            cosine, alpha, [&](float cos_i) { return 1.0f / excess(rows, cosine, cos_i); });
    });
}

SheenAlbedo::Rows SheenAlbedo::rows_at(float roughness)
{
    const float share = (roughness - min_roughness) / (1.0f - min_roughness);
    const float scaled = std::clamp(share, 0.0f, 1.0f) * (roughness_nodes - 1);
    const int lower = std::min(static_cast<int>(scaled), roughness_nodes - 2);
    return {lower, scaled - static_cast<float>(lower)};
}

float SheenAlbedo::look_up(const Table& table, Rows rows, float cosine) noexcept
{
    const float scaled = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * (cosine_nodes - 1);
    const int column = std::min(static_cast<int>(scaled), cosine_nodes - 2);
    const float fraction = scaled - static_cast<float>(column);
    const float* lower = table.data() + rows.lower * cosine_nodes + column;
    const float* upper = lower + cosine_nodes;
    return glm::mix(glm::mix(lower[0], lower[1], fraction), glm::mix(upper[0], upper[1], fraction),
                    rows.fraction);
}

float SheenAlbedo::excess(Rows rows, float cos_o, float cos_i) const noexcept
{
    const auto row = static_cast<std::size_t>(rows.lower);
    return exceeds_one_[row] || exceeds_one_[row + 1]
               ? std::max(look_up(excess_, rows, cos_o), look_up(excess_, rows, cos_i))
               : 1.0f;
}

float SheenAlbedo::value(Vec3 wo, Vec3 wi, float roughness) const noexcept
{
    const float alpha = to_alpha(roughness);
    const float cos_o = std::max(wo.z, min_cosine);
    const float cos_i = std::max(wi.z, min_cosine);
    return distribution(wo + wi, alpha) /
           (4.0f * cos_o * cos_i * (1.0f + lambda(cos_o, alpha) + lambda(cos_i, alpha)) *
            excess(rows_at(roughness), cos_o, cos_i));
}

float SheenAlbedo::directional(float cosine, float roughness) const noexcept
{
    return look_up(directional_, rows_at(roughness), cosine);
}

Sheen::Sheen(Rgb color, float roughness, const SheenAlbedo* albedo)
    : color_(color),
      roughness_(roughness),
      weight_(albedo != nullptr ? max_component(color) : 0.0f),
      albedo_(albedo)
{}

float Sheen::reflected(float cosine) const noexcept
{
    return weight_ == 0.0f ? 0.0f : weight_ * albedo_->directional(cosine, roughness_);
}

BsdfEval Sheen::eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
{
    const SolidAnglePdf pdf = cone_pdf(1.0f);
    return {color_ * (albedo_->value(wo, wi, roughness_) * wi.z), pdf, pdf};
}

std::optional<BsdfSample> Sheen::sample(Vec3, float, Vec2 u, TransportMode) const noexcept
{
    return towards(square_to_cone(u, 1.0f));
}

}  // namespace bdpt
