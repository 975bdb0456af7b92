#include "view/server/page.h"

#include <bdpt/eval/report/page_text.h>
#include <bdpt/version.h>

#include <nlohmann/json.hpp>

namespace bdpt::app {

std::string view_page()
{
    const nlohmann::ordered_json data{{"heat", eval::heat_text()}, {"version", BDPT_VERSION}};
    const std::string text = eval::script_safe(data.dump());
    return eval::fill_page(page_template(),
                           {{"style", page_style()}, {"data", text}, {"script", page_script()}});
}

}  // namespace bdpt::app
