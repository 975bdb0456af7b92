#pragma once

/// @file
/// Names the instruction sets that rays are traced with.
///
/// @code{.cpp}
/// bdpt::io::LoadedScene file = bdpt::io::load_gltf("model.glb");
/// const bdpt::Scene scene(std::move(file.scene), bdpt::Isa::avx2);  // the same bits on all CPUs
/// std::cout << "traced with " << bdpt::isa_name(scene.isa()) << '\n';
/// @endcode

#include <array>
#include <cstdint>

namespace bdpt {

/// Instruction set for ray tracing. Images are bit-identical only for the same instruction set,
/// because hits are rounded differently by each: pin it when machines of several kinds work on one
/// image (docs/decisions/0022-pinned-isa.md).
enum class Isa : std::uint8_t {
    native,  ///< the best one that this CPU supports
    sse2,    ///< available on every x86-64 CPU
    sse4_2,
    avx,
    avx2,
    avx512,
};

/// All instruction sets, in the order of the enumerators.
inline constexpr std::array all_isas{Isa::native, Isa::sse2, Isa::sse4_2,
                                     Isa::avx,    Isa::avx2, Isa::avx512};

/// Returns the name that people and Embree use: "sse4.2".
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
