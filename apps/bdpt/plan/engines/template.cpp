#include "plan/engines/template.h"

#include <algorithm>
#include <cstddef>

namespace bdpt::app {

std::string filled(const std::string& text,
                   const std::vector<std::pair<std::string, std::string>>& values)
{
    std::string result;
    std::size_t position = 0;
    while (position < text.size()) {
        const auto here = std::find_if(values.begin(), values.end(), [&](const auto& value) {
            const std::string mark = "@" + value.first + "@";
            return text.compare(position, mark.size(), mark) == 0;
        });
        if (here == values.end()) {
            result += text[position++];
        } else {
            result += here->second;
            position += here->first.size() + 2;
        }
    }
    return result;
}

}  // namespace bdpt::app
