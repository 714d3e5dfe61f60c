// Every function of functions() keeps its documented errors, in every variant and on every number of lanes.
#include <algorithm>
#include <set>

#include "device/kernel_sources.h"
#include "functions/tables.h"
#include "tests/cases/registry.h"
#include "tests/kernels/check.h"
#include "wrinkle/error.h"

namespace wrinkle::test {
namespace {

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Function& function : functions()) all.push_back(function.name);
    return all;
}

class EveryFunction : public testing::TestWithParam<std::string> {
protected:
    const Function& function = wrinkle::function(GetParam());
};

TEST_P(EveryFunction, KeepsItsDocumentedError) {
    ASSERT_TRUE(cases::registry().contains(function.name)) << "no cases: tests/cases/registry.cpp";
    const Cases cases = cases::registry().at(function.name)();
    for (const FunctionVariant& variant : function.variants) {
        std::vector<Answer> answers;
        std::size_t bound = 0;
        for (const Result& result : function.results)
            for (const ErrorMeasure measure : result.measures) {
                const double error = variant.max_errors.at(bound++);
                std::vector<std::string> outputs = result.columns();
                answers.push_back(
                    {result.name, outputs, measure, error, error, function.fp64_error, variant.everywhere});
            }
        ASSERT_EQ(bound, variant.max_errors.size());
        Checker(cases, answers, [&](bool fp64) { return cases::kernel_of(function, variant, fp64).body; }).run();
    }
}

TEST_P(EveryFunction, IsDescribedInFull) {
    EXPECT_FALSE(function.summary.empty() || function.source.empty() || function.results.empty());
    std::set<std::string> known;
    for (const auto& list : {function.parameters, {function.results.begin(), function.results.end()}})
        for (const Parameter& parameter : list) {
            EXPECT_TRUE(known.insert(parameter.name).second) << parameter.name << " is there twice";
            EXPECT_FALSE(parameter.unit.empty() || parameter.meaning.empty()) << parameter.name;
        }
    EXPECT_FALSE(kernel_source(function.file).empty());
    bool standard = false;
    for (const FunctionVariant& variant : function.variants) standard |= variant.precision == Precision::standard;
    EXPECT_TRUE(standard);
    EXPECT_TRUE(std::ranges::is_sorted(function.variants, {}, &FunctionVariant::precision));
}

TEST(EvaluateFunction, RefusesDoubleWhereThereIsNone) {
    Device device = test_device();
    device.info.fp64 = false;
    const Function& resolve = wrinkle::function("resolve");
    const std::vector<double> one(1, 1);
    ColumnsInDouble in;
    for (const Parameter& parameter : resolve.parameters)
        for (const std::string& column : parameter.columns()) in.emplace(column, one);
    try {
        evaluate_function(device, resolve, in, ColumnResultsInDouble{});
        ADD_FAILURE() << "evaluated";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("no double precision"), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Functions, EveryFunction, testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace wrinkle::test
