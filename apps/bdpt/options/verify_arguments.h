#pragma once

#include <bdpt/eval/verify/verify_options.h>

#include "options/render_arguments.h"

namespace bdpt::app {

/// What `bdpt verify` is to do.
struct VerifyArguments {
    RenderArguments stage{};  ///< which scene, seen how
    eval::VerifyOptions options{};
};

/// The options of `bdpt verify`, as they are given.
struct VerifyRequest {
    RenderRequest render{};  ///< what it shares with `bdpt render`; the rest is left alone
    eval::VerifyOptions options{};
};

extern const char* const verify_footer;

/// Adds the options of `bdpt verify`.
void add_verify_options(OptionList& options, VerifyRequest& request);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] VerifyArguments checked(const VerifyRequest& request, const OptionList& options);

}  // namespace bdpt::app
