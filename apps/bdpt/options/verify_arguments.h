#pragma once

#include <bdpt/eval/verify/verify_options.h>

#include "options/render_arguments.h"

namespace bdpt::app {

/// Arguments of `bdpt verify`.
struct VerifyArguments {
    RenderArguments stage{};  ///< scene and view
    eval::VerifyOptions options{};
};

/// Options of `bdpt verify`, as given.
struct VerifyRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    eval::VerifyOptions options{};
};

extern const char* const verify_footer;

/// Adds the options of `bdpt verify`.
void add_verify_options(OptionList& options, VerifyRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] VerifyArguments checked(const VerifyRequest& request, const OptionList& options);

}  // namespace bdpt::app
