#pragma once

/// @file
/// Computes the ids of Cryptomatte from names.
///
/// @code{.cpp}
/// const bdpt::NameId id = bdpt::name_id("chair");
/// std::cout << "chair: " << bdpt::hex_text(id) << '\n';
/// @endcode

#include <bdpt/export.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace bdpt {

/// The hash of a name, which an image stores as a float: its bits are neither zero, denormal,
/// infinite nor NaN [Friedman and Jones 2015, "Fully automatic ID mattes with support for motion
/// blur and transparency"; Cryptomatte specification 1.2.0, "ID generation"].
enum class NameId : std::uint32_t {
    none = 0,  ///< no name, because there is no surface
};

/// Returns the id of a name in UTF-8: its MurmurHash3_x86_32 [Appleby 2011] with seed 0, with bit
/// 23 flipped if the exponent bits of the float would be all 0 or all 1.
[[nodiscard]] BDPT_EXPORT NameId name_id(std::string_view name);

/// Tests whether `id` can be the id of a name.
[[nodiscard]] constexpr bool is_name_id(NameId id)
{
    const std::uint32_t exponent = static_cast<std::uint32_t>(id) >> 23 & 0xffU;
    return exponent != 0 && exponent != 0xff;
}

/// Returns the id as eight hexadecimal digits: "3ae39a5f".
[[nodiscard]] BDPT_EXPORT std::string hex_text(NameId id);

/// A name and its id.
struct NamedId {
    std::string name;
    NameId id = NameId::none;
    [[nodiscard]] bool operator==(const NamedId&) const = default;
};

/// The ids of a surface's object, material and instance.
struct SurfaceIds {
    NameId object = NameId::none;
    NameId material = NameId::none;
    NameId instance = NameId::none;
};

}  // namespace bdpt
