#include "options/groups/environment_arguments.h"

#include "options/values/value_types.h"

namespace bdpt::app {

void add_environment_options(OptionList& options, EnvironmentChange& change)
{
    options.add("--env-rotation", "DEG",
                "Rotate the environment about the vertical axis, counter-clockwise seen from "
                "above: 90 moves -z to -x [degrees]",
                change.rotation, number(-360.0, 360.0, "degrees from -360 to 360"));
    options.add("--env-intensity", "X", "Multiply the radiance of the environment by this",
                change.intensity, number(0.0, 1e6, "a factor from 0 to 1000000"));
}

}  // namespace bdpt::app
