#include <bdpt/part/render_result.h>

#include <bdpt/error.h>

#include <string>

namespace bdpt {

void merge(RenderResult& result, const RenderResult& other)
{
    if (const auto what = difference(result.identity, other.identity)) {
        throw Error(ErrorCode::invalid_input, "parts of different renders: " + *what);
    }
    if (const SampleSet both = result.samples.overlap(other.samples); !both.empty()) {
        throw Error(ErrorCode::invalid_input, "parts that both have the samples " + both.text());
    }
    result.film.merge(other.film);
    result.aovs.merge(other.aovs);
    result.ids.merge(other.ids);
    result.strategies.merge(other.strategies);
    result.samples.add(other.samples);
    result.stats += other.stats;
    result.seconds += other.seconds;
    result.cpu_seconds += other.cpu_seconds;
}

}  // namespace bdpt
