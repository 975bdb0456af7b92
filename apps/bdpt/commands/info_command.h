#pragma once

#include <bdpt/io/gltf.h>

#include <cstdint>
#include <optional>
#include <string>

#include "options/option_list.h"

namespace bdpt::app {

/// What `bdpt info` is to do.
struct InfoArguments {
    std::string file{};                         ///< empty: only the limits
    io::GltfOptions scene{};                    ///< what of the file is described
    std::optional<std::uint64_t> max_memory{};  ///< [bytes]
    bool limits = false;                        ///< print those that files are read with
    bool json = false;
};

extern const char* const info_footer;

/// Adds the options of `bdpt info`.
void add_info_options(OptionList& options, InfoArguments& arguments);

/// `bdpt info`: prints what a file holds on stdout. The result is the exit code. Throws `Error`.
[[nodiscard]] int run_info(const InfoArguments& arguments, const OptionList& options);

}  // namespace bdpt::app
