#pragma once

#include <array>
#include <cstdint>

namespace bdpt {

/// Instruction set that rays are traced with. Images are equal to the bit for the same one only,
/// as the rounding of hits differs between them: pin it where machines of several kinds work on one
/// image (docs/decisions/0022-pinned-isa.md).
enum class Isa : std::uint8_t {
    native,  ///< the best one of this CPU
    sse2,    ///< of every x86-64 CPU
    sse4_2,
    avx,
    avx2,
    avx512,
};

/// In the order of the enumerators.
inline constexpr std::array all_isas{Isa::native, Isa::sse2, Isa::sse4_2,
                                     Isa::avx,    Isa::avx2, Isa::avx512};

/// As people and Embree write it: "sse4.2".
[[nodiscard]] constexpr const char* isa_name(Isa isa)
{
    switch (isa) {
        case Isa::sse2:
            return "sse2";
        case Isa::sse4_2:
            return "sse4.2";
        case Isa::avx:
            return "avx";
        case Isa::avx2:
            return "avx2";
        case Isa::avx512:
            return "avx512";
        case Isa::native:
            break;
    }
    return "native";
}

}  // namespace bdpt
