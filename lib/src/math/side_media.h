#pragma once

#include <bdpt/types.h>

namespace bdpt {

/// What absorbs light on both sides of a surface [1/m] (Beer-Lambert).
struct SideMedia {
    Rgb behind{0.0f};
    Rgb ahead{0.0f};
};

}  // namespace bdpt
