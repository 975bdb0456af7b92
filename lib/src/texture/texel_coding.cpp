#include "texture/texel_coding.h"

#include <bdpt/srgb.h>

#include <array>
#include <limits>
#include <memory>

namespace bdpt {
namespace {

using Table8 = std::array<float, 256>;
using Table16 = std::array<float, 65536>;

[[nodiscard]] constexpr Table8 make_linear()
{
    Table8 table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(static_cast<double>(i) / 255.0);
    }
    return table;
}

[[nodiscard]] constexpr Table8 make_srgb()
{
    Table8 table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = srgb_to_linear(static_cast<double>(i) / 255.0);
    }
    return table;
}

constexpr Table8 linear_table = make_linear();
constexpr Table8 srgb_table = make_srgb();

/// Returns the table, computed at run time: it takes compilers too long, and few scenes need it.
[[nodiscard]] const Table16& srgb_table_16()
{
    static const std::unique_ptr<const Table16> table = [] {
        auto values = std::make_unique<Table16>();
        for (std::size_t i = 0; i < values->size(); ++i) {
            (*values)[i] = srgb_to_linear(static_cast<double>(i) / 65535.0);
        }
        return values;
    }();
    return *table;
}

}  // namespace

TexelCoding find_coding(TexelType type, Encoding encoding)
{
    const bool linear = encoding == Encoding::linear;
    switch (type) {
        case TexelType::unorm8:
            return {.table = linear ? linear_table.data() : srgb_table.data()};
        case TexelType::unorm16:
            return {.table = linear ? nullptr : srgb_table_16().data()};
        case TexelType::half:
        case TexelType::float32:
            break;
    }
    return {.table = nullptr,
            .most = encoding == Encoding::radiance ? std::numeric_limits<float>::max() : 1.0f};
}

const float* linear_table_8() noexcept
{
    return linear_table.data();
}

}  // namespace bdpt
