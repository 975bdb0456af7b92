#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// What is seen, as options of `bdpt render`: those of the command line, as pages have changed
/// them. All that is rendered, copied and saved comes from them, so that it is the same.
class ViewWords {
public:
    /// Takes over what was given to `bdpt view` and `bdpt render` knows.
    explicit ViewWords(const OptionList& given);

    void set(std::string_view option, std::string text);
    void remove(std::string_view option);
    [[nodiscard]] bool has(std::string_view option) const;
    /// The text of an option that was given; empty: it was not.
    [[nodiscard]] std::string text(std::string_view option) const;

    /// What they say. Throws `OptionError` for texts that make no sense, alone or together.
    [[nodiscard]] RenderArguments arguments() const;
    /// The command line that renders the same with `samples` per pixel, as one line for a shell.
    [[nodiscard]] std::string command(std::int64_t samples) const;
    /// The same as a job (options/job_file.h). All its paths are absolute, as it may be kept
    /// anywhere.
    [[nodiscard]] std::string job(std::int64_t samples) const;

    [[nodiscard]] bool operator==(const ViewWords&) const = default;

private:
    /// Gives all texts to `options`, which are those of `bdpt render`.
    void give_to(OptionList& options) const;
    /// The same with --spp in the place of all that ends a render.
    [[nodiscard]] ViewWords ending_after(std::int64_t samples) const;

    std::map<std::string, std::vector<std::string>, std::less<>> texts_;  ///< by name of option
};

}  // namespace bdpt::app
