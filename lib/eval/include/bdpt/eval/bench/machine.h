#pragma once

#include <bdpt/export.h>

#include <string>

namespace bdpt::eval {

/// What figures of time depend on beside the options; empty where it cannot be told.
struct MachineFacts {
    std::string cpu;        ///< model name
    int processors = 0;     ///< hardware threads that this process may use
    std::string system;     ///< kernel and its release
    std::string compiler;   ///< that made the library
    std::string libraries;  ///< that it was made with: "Embree 3.13.5, oneTBB 2021.8.0, ..."
};

/// Of the machine that runs this.
[[nodiscard]] BDPT_EXPORT MachineFacts machine_facts();

}  // namespace bdpt::eval
