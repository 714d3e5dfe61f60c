#pragma once

#include "tests/scene/scene_folder.h"

namespace wrinkle {

/// What the tests of all forms of decal tables share.
class DecalFolder : public SceneFolder {
protected:
    std::vector<Projector> read(const std::string& name, const std::string& bytes) const {
        return load_decals(write(name, bytes), 2);
    }
    std::string refusal(const std::string& name, const std::string& bytes) const {
        try {
            read(name, bytes);
        } catch (const Error& error) { return error.what(); }
        return "nothing was refused";
    }
    void expect_refused(const std::string& name, const std::string& bytes,
                        const std::vector<std::string>& parts) const {
        const std::string message = refusal(name, bytes);
        for (const std::string& part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message << "\n" << bytes;
    }
};

/// Expects the two decals that the test of each form writes in its own way.
inline void expect_two_decals(const std::vector<Projector>& rows) {
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].center, (Vec3{1, 2.5, -0.3}));
    EXPECT_EQ(rows[0].shape, ProjectorShape::cone);
    EXPECT_EQ(rows[0].texture, 1u);
    EXPECT_EQ(rows[0].half_size, (Vec3{0.25, 0.5, 0.5}));
    EXPECT_EQ(rows[0].mode, ProjectorMode::replace);
    EXPECT_EQ(rows[0].priority, -7);
    EXPECT_EQ(rows[0].wrap, Wrap::repeat);
    EXPECT_EQ(rows[0].object, 3);
    EXPECT_TRUE(rows[0].cryptomatte.empty());
    EXPECT_NEAR(rows[0].angle_fade[0], 0.5, 1e-15);                  // cos 60
    EXPECT_NEAR(rows[0].angle_fade[1], 0.98480775301220806, 1e-15);  // cos 10
    EXPECT_TRUE(rows[0].two_sided);
    EXPECT_EQ(rows[1].center, (Vec3{4, 5, 6}));
    EXPECT_EQ(rows[1].shape, ProjectorShape::box);
    EXPECT_EQ(rows[1].texture, 0u);
    EXPECT_EQ(rows[1].cryptomatte, "Rock");
    EXPECT_FALSE(rows[1].object);
    EXPECT_FALSE(rows[1].two_sided);
}

/// A mistake in a decal at (1, 2, 3), as CSV and as TOML write it, and what the message must contain.
struct DecalMistake {
    const char *columns, *fields, *toml;
    std::vector<std::string> csv_parts, toml_parts, parts;
};

inline const std::vector<DecalMistake>& decal_mistakes() {
    static const std::vector<DecalMistake> all{
        {"half_x",
         "0",
         "half_size = [0, 1, 1]",
         {"column \"half_x\" is \"0\""},
         {"element 1 of \"half_size\" is 0"},
         {"it must be a positive number"}},
        {"falloff_z",
         "1.5",
         "falloff = [0, 0, 1.5]",
         {"column \"falloff_z\" is \"1.5\""},
         {"element 3 of \"falloff\" is 1.5"},
         {"a number from 0 to 1"}},
        {"axis_x_y",
         "1e300",
         "axis_x = [1, 1e300, 0]",
         {"column \"axis_x_y\""},
         {"element 2 of \"axis_x\""},
         {"within the range of 32-bit floats"}},
        {"scale", "nan", "scale = nan", {"column \"scale\" is \"nan\""}, {"\"scale\" is nan"}, {"must be a number"}},
        {"texture", "2", "texture = 2", {"column \"texture\""}, {"\"texture\""}, {"is 2; the layer has 2 textures"}},
        {"texture", "0.5", "texture = 0.5", {"column \"texture\""}, {"\"texture\""}, {"must be a whole number"}},
        {"shape",
         "ball",
         "shape = \"ball\"",
         {"column \"shape\""},
         {"\"shape\""},
         {"\"ball\"", "\"box\", \"sphere\", \"cone\""}},
        {"s0,s1",
         "0.5,0.5",
         "region = [0.5, 0, 0.5, 1]",
         {"columns \"s0\", \"t0\", \"s1\", \"t1\""},
         {"\"region\""},
         {"must have s0 below s1, and t0 below t1"}},
        {"angle_full,angle_zero",
         "80,60",
         "angle_fade = [80, 60]",
         {"columns \"angle_full\", \"angle_zero\""},
         {"\"angle_fade\""},
         {"that gets all, then a larger one"}},
        {"object,cryptomatte",
         "1,Rock",
         "object = 1\ncryptomatte = \"Rock\"",
         {"columns \"object\", \"cryptomatte\""},
         {"\"object\", \"cryptomatte\""},
         {"cannot both be given"}},
        {"axis_x_x,axis_x_z",
         "0,0",
         "axis_x = [0, 0, 0]",
         {"columns \"axis_x_x\""},
         {"\"axis_x\", \"axis_y\""},
         {"not parallel, nor zero"}},
    };
    return all;
}

}  // namespace wrinkle
