#pragma once

#include <bdpt/part/identity.h>

#include <cstddef>
#include <optional>
#include <string>

#include "options/render_arguments.h"
#include "plan/plan.h"

namespace bdpt::app {

/// What a plan knows of the identity of one of its images: all of it or, as nobody loads every
/// frame to plan them, some components.
struct PlannedIdentity {
    Identity identity;
    bool whole = true;
};

/// That of image `image`. Of a sequence it has the options, the build and the seed of the image:
/// the scene of each frame follows from these and from the files.
[[nodiscard]] PlannedIdentity planned_identity(const Plan& plan, std::size_t image);

/// In what `planned` differs from `found`, as `difference()` of identities.
[[nodiscard]] std::optional<std::string> difference(const Identity& found,
                                                    const PlannedIdentity& planned);

/// What all images of the sequence of `asked` have in common, by the identity of one of them.
[[nodiscard]] Identity common_identity(const Identity& of_one, const RenderArguments& asked);

/// A component "file: NAME" for each file that the scene of `asked` is made of: its contents.
/// Throws `Error` (not_found, invalid_input).
[[nodiscard]] Identity identity_of_files(const RenderArguments& asked);

}  // namespace bdpt::app
