#pragma once

/// @file
/// Describes the machine that a benchmark runs on.
///
/// @code{.cpp}
/// const bdpt::eval::MachineFacts machine = bdpt::eval::machine_facts();
/// std::cout << machine.cpu << ", " << machine.processors << " threads\n";
/// @endcode

#include <bdpt/export.h>

#include <string>

namespace bdpt::eval {

/// Description of the machine and software that times depend on, beside the options; empty where
/// unknown.
struct MachineFacts {
    std::string cpu;        ///< model name
    int processors = 0;     ///< hardware threads available to this process
    std::string system;     ///< kernel and its release
    std::string compiler;   ///< compiler of the library
    std::string libraries;  ///< libraries it was built with: "Embree 3.13.5, oneTBB 2021.8.0, ..."
};

/// Returns the description of this machine.
[[nodiscard]] BDPT_EXPORT MachineFacts machine_facts();

}  // namespace bdpt::eval
