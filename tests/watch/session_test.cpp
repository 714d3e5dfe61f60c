// A scene that is watched: numbers, mistakes and files, without a server or a browser.
#include "watch/session.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/text_file.h"
#include "tests/device/test_device.h"
#include "tests/io/files.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

using nlohmann::json;

class WatchedScene : public testing::Test {
protected:
    static std::string text() {
        const std::string data = std::string(WRINKLE_SOURCE_DIR) + "/data/gbuffer/small";
        return "[gbuffer]\nfile = \"" + data + ".exr\"\n[camera]\nfile = \"" + data +
               ".camera.json\"\n[[layer]]\nname = \"tilt\"\nkind = \"constant\"\ngradient = [0.3, 0, 0]\nscale = 0.5  "
               "# kept\n";
    }

    WatchedScene() {
        test::test_device();  // sets where programs are kept
        write(text());
    }

    void write(const std::string& content) const { test::write_text(file_, content); }
    static json state(const WatchSession& session) { return json::parse(session.shown().state); }
    static std::vector<float> normals(const WatchSession& session) { return session.shown().image->out.at("normal.x"); }

    test::TempFolder folder_;
    const std::filesystem::path file_ = folder_ / "scene.toml";
};

TEST_F(WatchedScene, NumbersChangeThePictureAndThenTheFile) {
    WatchSession session(file_, {}, test::test_device_name());
    ASSERT_TRUE(session.evaluate());
    const auto first = normals(session);
    session.set_numbers({{"layer.0.scale", 0.75}});
    ASSERT_TRUE(session.evaluate());
    EXPECT_NE(normals(session), first);
    EXPECT_FALSE(session.shown().image->built);
    EXPECT_EQ(read_text(file_), text());
    EXPECT_EQ(state(session)["unsaved"], true);
    session.write_numbers();
    std::string expected = text();
    expected.replace(expected.find("scale = 0.5 "), 12, "scale = 0.75 ");
    EXPECT_EQ(read_text(file_), expected);
    session.look_at_files();
    ASSERT_TRUE(session.evaluate());
    EXPECT_EQ(state(session)["unsaved"], false);

    session.set_numbers({{"layer.0.scale", 1e300}});
    EXPECT_THROW(session.write_numbers(), Error) << "the scene may not hold it";
    session.set_numbers({{"layer.0.scale", 0.1}});
    write(text());
    EXPECT_THROW(session.write_numbers(), Error) << "somebody else changed the file";
    EXPECT_EQ(read_text(file_), text());
}

TEST_F(WatchedScene, MistakesLeaveTheLastGoodPicture) {
    WatchSession session(file_, {}, test::test_device_name());
    ASSERT_TRUE(session.evaluate());
    const auto image = session.shown().image;
    write(text() + "scael = 1\n");
    session.look_at_files();
    ASSERT_TRUE(session.evaluate());
    EXPECT_EQ(session.shown().image, image);
    ASSERT_EQ(state(session)["problems"].size(), 1u);
    EXPECT_EQ(state(session)["problems"][0]["line"], 10);
    write(text());
    session.look_at_files();
    ASSERT_TRUE(session.evaluate());
    EXPECT_TRUE(state(session)["problems"].empty());
    session.look_at_files();
    EXPECT_FALSE(session.evaluate()) << "nothing changed";
}

TEST_F(WatchedScene, LayersByThemselves) {
    WatchSession session(file_, {}, test::test_device_name());
    session.switch_off({"tilt"});
    ASSERT_TRUE(session.evaluate());
    const auto image = session.shown().image;
    const auto& base = image->frame->at("normal.x");
    double largest = 0;
    for (std::size_t i = 0; i < base.size(); ++i)
        largest = std::max(largest, static_cast<double>(std::abs(base[i] - image->out.at("normal.x")[i])));
    EXPECT_LT(largest, 1e-3);
    const json rows = json::parse(session.pixel(image->size.width / 2, image->size.height / 2));
    EXPECT_NE(rows.dump().find("footprint"), std::string::npos);
    EXPECT_THROW(session.pixel(image->size.width, 0), Error);
}

}  // namespace
}  // namespace wrinkle
