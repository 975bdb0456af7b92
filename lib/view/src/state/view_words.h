#pragma once

#include <bdpt/view.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"

/// The page of `bdpt view`, in the terms of the library of jobs.
namespace bdpt::view {

using namespace job;

/// The current view as options of `bdpt render`: those of the command line, as changed by pages.
/// Everything rendered, copied and saved uses them, so that all agree.
class ViewWords {
public:
    /// Takes the options given to `bdpt view` that `bdpt render` has, too. Without an option for
    /// adaptive sampling, all pixels take equally many samples.
    explicit ViewWords(const OptionList& given);

    void set(std::string_view option, std::string text);
    void remove(std::string_view option);
    [[nodiscard]] bool has(std::string_view option) const;
    /// Returns the text of an option; empty: not given.
    [[nodiscard]] std::string text(std::string_view option) const;

    /// Parses the words; without --spp and --noise, for `view_samples`. Throws `OptionError` for
    /// texts that are invalid, alone or together.
    [[nodiscard]] const RenderArguments& arguments() const;
    /// Returns the command line that renders the picture with `samples` per pixel to the bit, as
    /// one line for a shell.
    [[nodiscard]] std::string command(std::int64_t samples) const;
    /// Returns the command line of the final render: with --spp, --noise and --adaptive as given to
    /// `bdpt view`, else by the defaults of `bdpt render`.
    [[nodiscard]] std::string final_command() const;
    /// Returns the job of the final render (options/job_file.h). All its paths are absolute, as it
    /// may be saved anywhere.
    [[nodiscard]] std::string final_job() const;

    [[nodiscard]] bool operator==(const ViewWords& other) const { return texts_ == other.texts_; }

private:
    /// Stores all texts into `options`, which are those of `bdpt render`.
    void give_to(OptionList& options) const;
    /// Returns the words with --spp instead of all options that end a render.
    [[nodiscard]] ViewWords ending_after(std::int64_t samples) const;
    [[nodiscard]] ViewWords final_words() const;
    [[nodiscard]] std::string line() const;

    bool sets_adaptive_ = false;  ///< --adaptive was not given
    std::map<std::string, std::vector<std::string>, std::less<>> texts_;  ///< by name of option
    mutable std::shared_ptr<const RenderArguments> arguments_{};  ///< of `texts_`; null: not parsed
};

}  // namespace bdpt::view
