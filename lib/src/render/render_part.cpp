#include <bdpt/part/render_part.h>

#include <bdpt/error.h>

#include <string>

namespace bdpt {

void merge(RenderPart& part, const RenderPart& other)
{
    if (const auto what = difference(part.identity, other.identity)) {
        throw Error(ErrorCode::invalid_input, "parts of different renders: " + *what);
    }
    if (const SampleSet both = part.samples.overlap(other.samples); !both.empty()) {
        throw Error(ErrorCode::invalid_input, "parts that both have the samples " + both.text());
    }
    part.film.merge(other.film);
    part.aovs.merge(other.aovs);
    part.ids.merge(other.ids);
    part.strategies.merge(other.strategies);
    part.samples.add(other.samples);
    part.stats += other.stats;
    part.cpu_seconds += other.cpu_seconds;
}

}  // namespace bdpt
