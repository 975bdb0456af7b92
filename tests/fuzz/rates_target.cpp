#include <bdpt/io/part_file.h>

#include <algorithm>
#include <cstddef>

#include "fuzz_target.h"
#include "input_file.h"
#include "promises.h"

using namespace bdpt;

/// Rates of samples: an image of which only some pixels are allowed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::InputFile input;
    try {
        const SampleRates rates = io::read_rates(input.write(data, size));
        fuzz::promise(rates.exponents().size() == static_cast<std::size_t>(rates.width()) *
                                                      static_cast<std::size_t>(rates.height()),
                      "each pixel has a rate");
        fuzz::promise(rates.least() >= SampleRates::to_rate(SampleRates::min_exponent) &&
                          rates.greatest() <= SampleRates::to_rate(SampleRates::max_exponent),
                      "rates are in range");
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    }
    return 0;
}
