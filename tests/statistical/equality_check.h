#pragma once

#include "equal_means.h"
#include "equality_cases.h"

#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>

namespace bdpt::test {

/// What renders the case.
[[nodiscard]] RenderOptions options(const EqualityCase& test, IntegratorKind integrator,
                                    std::uint64_t seed);

/// Fails where the means differ, or are too noisy to tell. `what` goes into messages, as
/// "mis = bdpt"; `detectable_bias` is that of the case if it is not given.
void check_equal(const EqualityCase& test, const char* what, TileMeans& a, TileMeans& b,
                 std::optional<double> detectable_bias = std::nullopt);

}  // namespace bdpt::test
