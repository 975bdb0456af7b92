#pragma once

/// @file
/// Lists the integrators and what they can do.
///
/// @code{.cpp}
/// for (const bdpt::IntegratorInfo& integrator : bdpt::integrators()) {
///     std::cout << integrator.name << ": " << integrator.summary << '\n';
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <span>
#include <string_view>

namespace bdpt {

/// A light transport algorithm and its capabilities.
struct IntegratorInfo {
    IntegratorKind kind;
    std::string_view name;     ///< name in options and files
    std::string_view summary;  ///< phrase for help texts
    /// True if it traces light paths, which can reach the lens from anywhere and splat on any
    /// pixel.
    bool traces_light_paths;
    /// True if each of its strategies (s, t) can have an image of its own.
    bool has_strategies;
    /// True if its expected value at a finite number of samples differs from the limit.
    bool biased = false;
};

/// Returns all integrators. To add one: create a folder in lib/src/integrator, an enumerator of
/// `IntegratorKind` and a line in the table behind this function.
[[nodiscard]] BDPT_EXPORT std::span<const IntegratorInfo> integrators();

/// Returns the entry of one integrator.
[[nodiscard]] BDPT_EXPORT const IntegratorInfo& info(IntegratorKind kind);

}  // namespace bdpt
