#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace bdpt {

/// A number in [0, 1] in 16 bits: twice the precision that material parameters need.
class Unit16 {
public:
    Unit16() = default;
    /// Clamps `value` to [0, 1].
    explicit Unit16(float value)
        : bits_(static_cast<std::uint16_t>(std::clamp(value, 0.0f, 1.0f) * 65535.0f + 0.5f))
    {}
    [[nodiscard]] float value() const { return static_cast<float>(bits_) * (1.0f / 65535.0f); }
    [[nodiscard]] bool operator==(const Unit16&) const = default;

private:
    std::uint16_t bits_ = 0;
};

/// A number in [0, 1] in 8 bits.
class Unit8 {
public:
    Unit8() = default;
    /// Clamps `value` to [0, 1].
    explicit Unit8(float value)
        : bits_(static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f))
    {}
    [[nodiscard]] float value() const { return static_cast<float>(bits_) * (1.0f / 255.0f); }
    [[nodiscard]] bool operator==(const Unit8&) const = default;

private:
    std::uint8_t bits_ = 0;
};

/// A colour in [0, 1] in 48 bits.
class Color16 {
public:
    Color16() = default;
    explicit Color16(Rgb color) : r_(color.r), g_(color.g), b_(color.b) {}
    [[nodiscard]] Rgb value() const { return {r_.value(), g_.value(), b_.value()}; }
    [[nodiscard]] bool operator==(const Color16&) const = default;

private:
    Unit16 r_;
    Unit16 g_;
    Unit16 b_;
};

/// A pointer without alignment requirement, so that it causes no padding among numbers.
template <typename T>
class PackedPointer {
public:
    PackedPointer() = default;
    explicit PackedPointer(T* pointer) : bits_(std::bit_cast<Bits>(pointer)) {}
    [[nodiscard]] T* get() const { return std::bit_cast<T*>(bits_); }
    [[nodiscard]] T& operator*() const { return *get(); }
    [[nodiscard]] T* operator->() const { return get(); }
    [[nodiscard]] bool operator==(const PackedPointer&) const = default;

private:
    using Bits = std::array<std::uint32_t, sizeof(T*) / sizeof(std::uint32_t)>;
    Bits bits_{};
};

/// A unit vector in 48 bits; exact along the axes, otherwise accurate to 3e-5 rad.
class Direction16 {
public:
    Direction16() = default;
    explicit Direction16(Vec3 w) : x_(signed16(w.x)), y_(signed16(w.y)), z_(signed16(w.z)) {}
    [[nodiscard]] Vec3 value() const
    {
        return normalize(
            Vec3{static_cast<float>(x_), static_cast<float>(y_), static_cast<float>(z_)});
    }
    [[nodiscard]] bool operator==(const Direction16&) const = default;

private:
    [[nodiscard]] static std::int16_t signed16(float value)
    {
        const float scaled = std::clamp(value, -1.0f, 1.0f) * 32767.0f;
        return static_cast<std::int16_t>(scaled + (scaled < 0.0f ? -0.5f : 0.5f));
    }

    std::int16_t x_ = 0;
    std::int16_t y_ = 0;
    std::int16_t z_ = 32767;
};

}  // namespace bdpt
