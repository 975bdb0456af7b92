#pragma once

#include <bdpt/io/gltf.h>

#include <cstdint>
#include <optional>
#include <string>

#include "options/option_list.h"

namespace bdpt::app {

/// Arguments of `bdpt info`.
struct InfoArguments {
    std::string file{};                         ///< empty: only the limits
    io::GltfOptions scene{};                    ///< selects the part of the file to describe
    std::optional<std::uint64_t> max_memory{};  ///< [bytes]
    bool limits = false;                        ///< print the limits for reading files
    bool json = false;
};

extern const char* const info_footer;

/// Adds the options of `bdpt info`.
void add_info_options(OptionList& options, InfoArguments& arguments);

/// Runs `bdpt info`: prints the contents of a file on stdout. Returns the exit code. Throws
/// `Error`.
[[nodiscard]] int run_info(const InfoArguments& arguments, const OptionList& options);

}  // namespace bdpt::app
