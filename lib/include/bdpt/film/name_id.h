#pragma once

#include <bdpt/export.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace bdpt {

/// The hash of a name, which an image stores as a float: its bits are neither zero, denormal,
/// infinite nor NaN [Friedman and Jones 2015, "Fully automatic ID mattes with support for motion
/// blur and transparency"; Cryptomatte specification 1.2.0, "ID generation"].
enum class NameId : std::uint32_t {
    none = 0,  ///< of no name: where no surface is
};

/// That of a name in UTF-8: its MurmurHash3_x86_32 [Appleby 2011] with seed 0, and with bit 23
/// flipped where the bits of a float's exponent would be all 0 or all 1.
[[nodiscard]] BDPT_EXPORT NameId name_id(std::string_view name);

/// Is it the id of any name?
[[nodiscard]] constexpr bool is_name_id(NameId id)
{
    const std::uint32_t exponent = static_cast<std::uint32_t>(id) >> 23 & 0xffU;
    return exponent != 0 && exponent != 0xff;
}

/// "3ae39a5f": eight hexadecimal digits.
[[nodiscard]] BDPT_EXPORT std::string hex_text(NameId id);

/// A name and what stands for it.
struct NamedId {
    std::string name;
    NameId id = NameId::none;
    [[nodiscard]] bool operator==(const NamedId&) const = default;
};

/// The object and the material of a surface.
struct SurfaceIds {
    NameId object = NameId::none;
    NameId material = NameId::none;
};

}  // namespace bdpt
