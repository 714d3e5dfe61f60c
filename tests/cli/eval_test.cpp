// wrinkle eval: rows of numbers through one kernel function.
#include "functions/reference.h"
#include "io/csv_table.h"
#include "io/npy_file.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

const std::string slopes = "n.x,n.y,n.z,g.x,g.y,g.z\n0,0,1,0.75,0,0\n0,0,1,0,0,0\n";

TEST(Eval, ResultsFollowTheColumnsOfTheInput) {
    const Workplace place;
    write_text(place / "in.csv", slopes);
    const Ran ran = place.run("eval resolve --in in.csv");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out,
              "n.x,n.y,n.z,g.x,g.y,g.z,normal.x,normal.y,normal.z\n"
              "0,0,1,0.75,0,0,-0.6,0,0.8\n0,0,1,0,0,0,0,0,1\n");
}

TEST(Eval, TakesColumnsInAnyOrderAndPassesOthersThroughInPlace) {
    const Workplace place;
    write_text(place / "in.csv",
               "\xef\xbb\xbf"
               "name,g.x,normal.x,n.x,n.z,g.z,\"note, long\",n.y,g.y\r\n"
               "\"a, b\",0.75,9,0,1,0,\" x\",0,0\r\n");
    const Ran ran = place.run("eval resolve --in - --out out.csv", "", "in.csv");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(read_text(place / "out.csv"),
              "name,g.x,normal.x,n.x,n.z,g.z,\"note, long\",n.y,g.y,normal.y,normal.z\n"
              "\"a, b\",0.75,-0.6,0,1,0,\" x\",0,0,0,0.8\n");
}

TEST(Eval, DoubleHasAllItsDigits) {
    const Workplace place;
    write_text(place / "in.csv", "n.x,n.y,n.z,g.x,g.y,g.z\n0,0,1,0.1,0.2,0\n");
    const auto first = [&](const std::string& options) {
        const Ran ran = place.run("eval resolve --in in.csv " + options);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return io::CsvTable(ran.out, "out").numbers<double>("normal.x").at(0);
    };
    const double want = -0.1 / std::sqrt(1.05);
    EXPECT_NEAR(first("--precision double"), want, 1e-15);
    EXPECT_NEAR(first(""), want, 1e-7);
    EXPECT_NE(first(""), want);
    EXPECT_NEAR(first("--precision exact"), want, 1e-7);
}

TEST(Eval, MissingColumnsAreNamedWithTheNearestOnes) {
    const Workplace place;
    write_text(place / "in.csv", "n.x,n.y,nz,g.x,g.y\n0,0,1,0,0\n");
    expect_failed(place.run("eval resolve --in in.csv"),
                  {"resolve", "in.csv", "\"n.z\"; did you mean \"nz\"", "\"g.z\""});
    write_text(place / "in.csv", "n.x;n.y;n.z\n0;0;1\n");
    expect_failed(place.run("eval resolve --in in.csv"), {"in.csv:1: separated by ';': save with commas"});
}

TEST(Eval, BadCellsAreNamedAndNothingIsWritten) {
    const Workplace place;
    const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
        write_text(place / "in.csv", text);
        expect_failed(place.run("eval resolve --in in.csv --out out.csv"), parts);
        EXPECT_FALSE(fs::exists(place / "out.csv"));
    };
    refused(slopes + "0,0,1,x,0,0\n", {"in.csv:4", "row 3", "\"g.x\"", "\"x\""});
    refused(slopes + "0,0,,0,0,0\n", {"row 3", "\"n.z\"", "empty"});
    refused(slopes + "0,0,1,0\n", {"in.csv:4", "row 3", "4 cells", "6 columns"});
    refused("", {"in.csv", "empty"});
    expect_failed(place.run("eval resolve"), {"standard input", "empty"});
    expect_failed(place.run("eval resolve --in none.csv"), {"none.csv", "no such file"});
    write_text(place / "in.csv", slopes);
    expect_failed(place.run("eval resolve --in in.csv --out nowhere/out.csv"), {"nowhere"});
    write_text(place / "in.csv", "n.x,n.y,n.z,g.x,g.y,g.z\n");
    EXPECT_EQ(place.run("eval resolve --in in.csv").out, "n.x,n.y,n.z,g.x,g.y,g.z,normal.x,normal.y,normal.z\n");
}

TEST(Eval, ArraysComeAndGo) {
    const Workplace place;
    const std::size_t shape[] = {2, 2, 3};
    const auto array = [&](const std::string& name, const std::vector<float>& values) {
        write_text(place / name, io::npy_header<float>(shape) +
                                     std::string(reinterpret_cast<const char*>(values.data()), values.size() * 4));
    };
    array("n.npy", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0});
    array("g.npy", {0, 0, 0, 0.75f, 0, 0, 0, 0.75f, 0, 0, 0, 0});
    const std::string in = "eval resolve --in n=n.npy --in g=g.npy ";
    Ran ran = place.run(in + "--out normal=out.npy --out normal=out.exr");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto got = io::read_npy<double>(place / "out.npy");
    EXPECT_EQ(got.shape, (std::vector<std::size_t>{2, 2, 3}));
    const double want[] = {0, 0, 1, -0.6, 0, 0.8, 0, -0.6, 0.8, 0, 1, 0};
    for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(got.values.at(i), want[i], 1e-7);
    // What was written can be read again; pictures and arrays mix.
    ran = place.run("eval resolve --in n=out.exr:normal --in g=g.npy");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(io::CsvTable(ran.out, "out").rows(), 4u);
    ran = place.run("eval resolve --precision double --in n=out.exr:normal --in g=g.npy --out normal=twice.npy");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(read_text(place / "twice.npy").find("<f8"), std::string::npos);

    write_text(place / "in.csv", "g.x,g.y,g.z\n0,0,0\n");
    expect_failed(place.run("eval resolve --in n=n.npy --in in.csv"), {"in.csv", "1 rows", "n.npy", "2 x 2"});
    expect_failed(place.run("eval resolve --in n=n.npy"), {"needs g", "--in g=FILE.npy", "\"g.x\""});
    expect_failed(place.run("eval resolve --in n=n.npy --in h=g.npy"), {"no parameter \"h\""});
    expect_failed(place.run("eval resolve --in n=out.exr:nothing --in g=g.npy"), {"out.exr", "nothing", "normal.XYZ"});
    expect_failed(place.run("eval tangent_frame --in dst_dx=n.npy"), {"n.npy is 2 x 2 x 3", "dst_dx", "N x 2"});
    expect_failed(place.run(in + "--out normals=out.npy"), {"normals", "\"normal\""});
    expect_failed(place.run(in + "--out out.npy"), {"--out normal=out.npy"});
    expect_failed(place.run(in + "--out normal=out.txt"), {"out.txt", ".npy"});
    write_text(place / "in.csv", slopes);
    expect_failed(place.run("eval resolve --in in.csv --out normal=flat.exr"), {"flat.exr", "height x width"});
}

TEST(Eval, SettingsAreNumbersTexturesAndCameras) {
    const Workplace place;
    write_text(place / "in.csv", "n.x,n.y,n.z\n0.6,0,0.8\n");
    const auto weights = [&](const std::string& options) {
        const Ran ran = place.run("eval triplanar_weights --in in.csv " + options);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return io::CsvTable(ran.out, "out").numbers<double>("w.x").at(0);
    };
    EXPECT_EQ(weights(""), weights("--set sharpness=3"));
    EXPECT_NEAR(weights("--set sharpness=1"), 0.4, 1e-6);
    expect_failed(place.run("eval triplanar_weights --in in.csv --set sharp=1"), {"\"sharp\""});
    const Ran soft = place.run("eval triplanar_weights --in in.csv --set sharpness=soft");
    expect_failed(soft, {"sharpness", "soft"});
    EXPECT_EQ(soft.code, 2);
    expect_failed(place.run("eval triplanar_weights --in in.csv --set sharpness=nan"), {"sharpness", "nan", "from 0"});
    write_text(place / "q.csv", "p.x,p.y,p.z,footprint\n1,2,3,0\n");
    for (const char* octaves : {"17", "2.5", "100000000"})
        expect_failed(place.run(fmt::format("eval fractal_sum --in q.csv --set octaves={}", octaves)),
                      {"octaves", "whole numbers from 1 to 16"});
    expect_failed(place.run("eval triplanar_weights --in in.csv --set sharpness"), {"NAME=VALUE"});

    const std::string camera = Workplace::data_file("gbuffer/small.camera.json");
    write_text(place / "p.csv", "n.x,n.y,n.z,p.x,p.y,p.z,x,y\n0,0,1,0,0,-2,10.5,20.5\n");
    const std::string derive = "eval screen_derivatives --in p.csv --set camera=" + camera;
    EXPECT_EQ(place.run(derive).code, 0);
    EXPECT_EQ(place.run(derive).out, place.run(derive + " --size 120x68").out) << "its file says 120 x 68";
    expect_failed(place.run("eval screen_derivatives --in p.csv"), {"\"camera\"", "camera"});
    expect_failed(place.run(derive + " --size 100x100"), {"aspect"});
    expect_failed(place.run(derive + " --size 100"), {"WIDTHxHEIGHT"});
    write_text(place / "st.csv", "st.x,st.y,lod\n0.3,0.4,0\n");
    const Ran slope = place.run("eval height_slope_plain --in st.csv --set heights=" +
                                Workplace::data_file("textures/cobbles_height.png"));
    EXPECT_EQ(slope.code, 0) << slope.err;
    expect_failed(place.run("eval height_slope_plain --in st.csv --set heights=none.png"), {"none.png"});
    write_text(place / "p.csv", "p.x,p.y,p.z\n0.5,0.5,0.5\n");
    const std::string noise = " --set volume=" + Workplace::data_file("volumes/noise.vdb");
    const Ran value = place.run("eval volume_trilinear --in p.csv" + noise);
    EXPECT_EQ(value.code, 0) << value.err;
    EXPECT_EQ(place.run("eval volume_trilinear --in p.csv" + noise + "#density").out, value.out);
    expect_failed(place.run("eval volume_vector --in p.csv" + noise), {"noise.vdb", "holds numbers", "vectors"});
}

TEST(Eval, PixelCentresOfPicturesAreKnown) {
    const Workplace place;
    const std::string frame = Workplace::data_file("gbuffer/small.exr");
    const Ran ran = place.run("eval screen_derivatives --in n=" + frame + ":Normal --in p=" + frame +
                              ":Position --set camera=" + Workplace::data_file("gbuffer/small.camera.json") +
                              " --out dp_dx=d.exr --out dp_dy=d.exr");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(place.run("info d.exr").code, 0);
}

TEST(Eval, KnowsItsFunctions) {
    const Workplace place;
    expect_failed(place.run("eval resolv --in in.csv"), {"\"resolv\"", "\"resolve\""});
    EXPECT_EQ(place.run("eval").code, 2);
    EXPECT_EQ(place.run("eval resolve --precision best").code, 2);
    const std::string list = place.run("eval --list").out;
    for (const Function& function : functions()) {
        EXPECT_NE(list.find("  " + function.name + "\n"), std::string::npos) << function.name;
        const Ran help = place.run("eval " + function.name + " --help");
        EXPECT_EQ(help.code, 0) << help.err;
        for (const Parameter& parameter : function.parameters)
            expect_mentions(help.out, {parameter.columns()[0], parameter.meaning, parameter.unit});
        expect_mentions(help.out, {function.source, function.note, "standard", function_example(function)});
    }
    EXPECT_NE(place.run("eval --help").out.find("--precision"), std::string::npos);
}

/// Every example, as a user would paste it in the source folder.
TEST(Eval, ExamplesRun) {
    const Workplace place;
    fs::create_directory_symlink(data_folder, place / "data");
    ASSERT_EQ(place.run("bake-volume golden-gradient --size 16 -o gradient.vdb").code, 0);
    for (const Function& function : functions()) {
        const std::string example = function_example(function);
        const std::size_t command = example.find("wrinkle ");
        const Ran ran =
            place.run(example.substr(command + 8), example.substr(0, example.find(" | ")) + " > in.csv;", "in.csv");
        EXPECT_EQ(ran.code, 0) << example << "\n" << ran.err;
        for (const Result& result : function.results) expect_mentions(ran.out, {result.columns()[0]});
    }
}

/// bench/gpu_code.py compiles them, once.
TEST(Eval, PrintsEveryFunctionAsAKernel) {
    const Workplace place;
    const std::string kernels = place.run("eval --kernels").out;
    EXPECT_EQ(kernels.find("#include"), kernels.rfind("#include"));
    for (const Function& function : functions())
        for (const FunctionVariant& variant : function.variants)
            expect_mentions(
                kernels, {"kernel void wr_columns_" + function.name + "_" + precision_name(variant.precision) + "("});
}

TEST(Reference, PageIsWhatTheTableGives) {
    EXPECT_EQ(read_text(fs::path(WRINKLE_SOURCE_DIR) / "kernels/README.md"), reference_page())
        << "write it anew: build/release/wrinkle eval --reference > kernels/README.md";
}

}  // namespace
}  // namespace wrinkle::test
