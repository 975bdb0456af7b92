#pragma once

#include <string>
#include <vector>

namespace bdpt {

/// Named channels of an image, as files of many layers hold them.
struct Layer {
    std::string name;      ///< "normal"; empty: the main layer
    std::string channels;  ///< one letter each, in the order of the values: "XYZ"
    int width = 0;
    int height = 0;
    std::vector<float> values;  ///< row-major from the top left, the channels of a pixel together
};

}  // namespace bdpt
