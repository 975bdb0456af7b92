#include "catch.hpp"

#include <bdpt/error.h>
#include <bdpt/io/read_limits.h>

#include <string>

namespace bdpt::test::memory_budget_test {
using namespace bdpt::io;

namespace {

Error refusal(MemoryBudget& budget, const char* what, std::uint64_t bytes)
{
    try {
        budget.spend(what, bytes);
    } catch (const Error& error) {
        return error;
    }
    FAIL("was not refused");
    return {ErrorCode::internal, ""};
}

}  // namespace

TEST_CASE("a budget of memory says who asks for how much, what is left of it and whose limit it is")
{
    MemoryBudget budget({.bytes = 1'000'000, .source = "--max-memory"});
    const Error at_once = refusal(budget, "the film of 7x9 pixels", 1'000'001);
    CHECK(at_once.code() == ErrorCode::invalid_input);
    CHECK(std::string(at_once.what()) ==
          "the film of 7x9 pixels needs 1 MB of memory, but the limit is 1 MB (--max-memory)");
    budget.spend("the film", 600'000);
    budget.check("a file", 400'000);  // takes nothing
    CHECK(budget.left() == 400'000);
    CHECK(std::string(refusal(budget, "/images/3", 400'001).what()) ==
          "/images/3 needs 400 kB of memory, but 400 kB of 1 MB are left (--max-memory)");
    budget.spend("/images/3", 400'000);
    CHECK(budget.left() == 0);
    CHECK(budget.spent() == 1'000'000);
    budget.spend("nothing", 0);
    // No sum of numbers, however large, comes round.
    CHECK_THROWS_AS(budget.check("all", ~std::uint64_t{0}), Error);

    MemoryBudget machine(
        {.bytes = 10, .source = "free memory of the machine", .code = ErrorCode::out_of_memory});
    CHECK(refusal(machine, "it", 11).code() == ErrorCode::out_of_memory);
}

}  // namespace bdpt::test::memory_budget_test
