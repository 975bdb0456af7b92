#include "report/rates_report.h"

#include <bdpt/eval/image/false_color.h>
#include <bdpt/io/png.h>
#include <bdpt/io/rates_file.h>

#include "options/values/output_files.h"

namespace bdpt::app {

void save_rates(const std::filesystem::path& file, const SampleRates& rates,
                const io::ImageMetadata& metadata)
{
    if (has_extension(file, ".exr")) {
        io::write_rates(file, rates, metadata);
        return;
    }
    eval::ErrorMap map{.width = rates.width(), .height = rates.height(), .values = {}};
    for (const std::int8_t exponent : rates.exponents()) {
        map.values.push_back(SampleRates::to_rate(exponent));
    }
    const float most = SampleRates::to_rate(SampleRates::max_exponent);
    io::write_png(file, eval::false_color(map, {.scale = most, .title = "samples per round"}),
                  {.metadata = metadata});
}

}  // namespace bdpt::app
