#pragma once

#include <bdpt/part/identity.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"
#include "plan/plan.h"

namespace bdpt::job {

/// Completes `render --plan FILE --task I` and `merge --plan FILE` in `words` of a command line by
/// the plan; other command lines are unchanged. Throws `Error`: those of `read_plan`, and usage for
/// words that contradict the plan.
[[nodiscard]] std::vector<std::string> with_planned_words(std::vector<std::string> words);

/// Returns the requested task of `plan`, which is in `file`: by its index, or by "env:NAME", an
/// environment variable with the index. Throws `OptionError`.
[[nodiscard]] const PlanTask& find_task(const Plan& plan, const std::filesystem::path& file,
                                        const std::string& asked);

/// Returns the words after `bdpt render` that all tasks of `plan`, which is in `file`, share: the
/// scene and the options, without samples and files that are written.
[[nodiscard]] std::vector<std::string> shared_words(const Plan& plan,
                                                    const std::filesystem::path& file);

/// Planned identity of an image: complete or, as frames are planned without loading each, some of
/// its components.
struct PlannedIdentity {
    Identity identity;
    bool whole = true;
};

/// Returns the identity of image `image`. For a sequence it has the options, the build and the seed
/// of the image: the scene of each frame follows from these and from the files.
[[nodiscard]] PlannedIdentity planned_identity(const Plan& plan, std::size_t image);

/// Returns the difference of `planned` from `found`, as `difference()` of identities.
[[nodiscard]] std::optional<std::string> difference(const Identity& found,
                                                    const PlannedIdentity& planned);

/// Returns the components that all images of the sequence of `asked` share, given the identity of
/// one of them.
[[nodiscard]] Identity common_identity(const Identity& of_one, const RenderArguments& asked);

/// Returns a component "file: NAME" with the contents of each file of the scene of `asked`. Throws
/// `Error` (not_found, invalid_input).
[[nodiscard]] Identity identity_of_files(const RenderArguments& asked);

}  // namespace bdpt::job
