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

/// The machine and software that times depend on, beside the options; empty where unknown.
struct MachineFacts {
    std::string cpu;        ///< model name
    int processors = 0;     ///< hardware threads that this process may use
    std::string system;     ///< kernel and its release
    std::string compiler;   ///< that made the library
    std::string libraries;  ///< that it was made with: "Embree 3.13.5, oneTBB 2021.8.0, ..."
};

/// The description of this machine.
[[nodiscard]] BDPT_EXPORT MachineFacts machine_facts();

}  // namespace bdpt::eval
