#pragma once

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <span>
#include <string_view>

namespace bdpt {

/// A light transport algorithm and what it can do.
struct IntegratorInfo {
    IntegratorKind kind;
    std::string_view name;     ///< in options and files
    std::string_view summary;  ///< a phrase for help texts
    /// Traces light paths, which can reach the lens from anywhere and splat on any pixel.
    bool traces_light_paths;
    /// Its strategies (s, t) can have images of their own.
    bool has_strategies;
    /// Its mean at any number of samples is not the limit.
    bool biased = false;
};

/// All there are. To add one: a folder in lib/src/integrator, an enumerator of `IntegratorKind` and
/// a line in the table behind this function.
[[nodiscard]] BDPT_EXPORT std::span<const IntegratorInfo> integrators();

/// The entry of one of them.
[[nodiscard]] BDPT_EXPORT const IntegratorInfo& info(IntegratorKind kind);

}  // namespace bdpt
