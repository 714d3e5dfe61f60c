#include "io/gbuffer_roles.h"

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using test::blender_channels;
using test::error_of;
using test::expect_mentions;
using Names = std::vector<std::string>;

void expect_channels(const RoleMap& map, const std::map<std::string, std::string>& expected) {
    for (const auto& [plane, channel] : expected) {
        const auto found = map.channel_of.find(plane);
        ASSERT_NE(found, map.channel_of.end()) << plane;
        EXPECT_EQ(found->second, channel) << plane;
    }
}

GBufferSource with_roles(const std::map<std::string, std::string>& roles) {
    GBufferSource source;
    source.roles = roles;
    return source;
}

Names layers(std::initializer_list<std::pair<const char*, const char*>> parts) {
    Names names;
    for (const auto& [layer, components] : parts)
        for (const char* c = components; *c != 0; ++c) names.push_back(std::string(layer) + "." + *c);
    return names;
}

TEST(Roles, EveryRoleHasThePlanesOfTheContract) {
    EXPECT_EQ(gbuffer_roles().size(), 26u);
    EXPECT_EQ(gbuffer_roles().front().planes, (Names{"position.x", "position.y", "position.z"}));
}

TEST(Roles, Blender) {
    const auto map = detect_roles(blender_channels);
    EXPECT_EQ(map.writer, Writer::blender);
    EXPECT_EQ(map.depth, DepthKind::planar);
    expect_channels(map, {{"position.y", "ViewLayer.Position.Y"},
                          {"normal.z", "ViewLayer.Normal.Z"},
                          {"depth", "ViewLayer.Depth.Z"},
                          {"uv.u", "ViewLayer.UV.U"},
                          {"uv.v", "ViewLayer.UV.V"},
                          {"object", "ViewLayer.IndexOB.X"},
                          {"beauty.r", "ViewLayer.Combined.R"},
                          {"crypto.id0", "ViewLayer.CryptoObject00.r"},
                          {"crypto.coverage1", "ViewLayer.CryptoObject00.a"},
                          {"crypto.id2", "ViewLayer.CryptoObject01.r"}});
    EXPECT_EQ(map.cryptomatte_ranks, 4);
    EXPECT_EQ(map.cryptomatte_layer, "ViewLayer.CryptoObject");
    EXPECT_FALSE(map.has_role("albedo"));
    EXPECT_FALSE(map.has_role("dp_du"));
}

TEST(Roles, WhatSurfacesMirror) {
    expect_channels(
        detect_roles(layers(
            {{"VL.Normal", "XYZ"}, {"VL.GlossDir", "RGB"}, {"VL.Glossy Indirect", "RGB"}, {"VL.GlossCol", "RGB"}})),
        {{"specular_direct.r", "VL.GlossDir.R"},
         {"specular_indirect.b", "VL.Glossy Indirect.B"},
         {"specular_color.g", "VL.GlossCol.G"}});
    expect_channels(detect_roles(layers({{"P", "XYZ"}, {"N", "XYZ"}, {"specular", "RGB"}})),
                    {{"specular.r", "specular.R"}});
    const auto unreal = detect_roles(
        layers({{"FinalImageMovieRenderQueue_WorldNormal", "RGB"}, {"FinalImageMovieRenderQueue_Specular", "RGB"}}));
    EXPECT_FALSE(unreal.has_role("specular")) << "a number of the material there";
}

TEST(Roles, LightThatNoBumpChanges) {
    expect_channels(detect_roles(layers({{"VL.Normal", "XYZ"},
                                         {"VL.Emit", "RGB"},
                                         {"VL.TransDir", "RGB"},
                                         {"VL.TransInd", "RGB"},
                                         {"VL.Transmission Color", "RGB"}})),
                    {{"emission.g", "VL.Emit.G"},
                     {"transmission_direct.r", "VL.TransDir.R"},
                     {"transmission_indirect.b", "VL.TransInd.B"},
                     {"transmission_color.g", "VL.Transmission Color.G"}});
    const auto map = detect_roles(layers({{"N", "XYZ"}, {"emission", "RGB"}, {"transmission", "RGB"}}));
    expect_channels(map, {{"emission.r", "emission.R"}, {"transmission.r", "transmission.R"}});
    EXPECT_FALSE(map.has_role("transmission_direct"));
}

TEST(Roles, TangentsWithTheirSign) {
    auto names = layers({{"VL.Normal", "XYZ"}, {"VL.Tangent", "XYZW"}, {"VL.Bitangent", "XYZ"}});
    expect_channels(
        detect_roles(names),
        {{"tangent.z", "VL.Tangent.Z"}, {"tangent_sign", "VL.Tangent.W"}, {"bitangent.x", "VL.Bitangent.X"}});
    names = layers({{"N", "XYZ"}, {"tangent", "RGBA"}});  // alpha is coverage, unless an override says otherwise
    EXPECT_TRUE(detect_roles(names).has_role("tangent"));
    EXPECT_FALSE(detect_roles(names).has_role("tangent_sign"));
    expect_channels(detect_roles(names, with_roles({{"tangent_sign", "tangent.A"}})), {{"tangent_sign", "tangent.A"}});
    names = layers({{"N", "XYZ"}, {"world_tangent", "XYZ"}});
    names.push_back("tangent_sign");
    expect_channels(detect_roles(names), {{"tangent.x", "world_tangent.X"}, {"tangent_sign", "tangent_sign"}});
}

TEST(Roles, BlenderViewLayersAreNotMixed) {
    auto names =
        layers({{"Back.Normal", "XYZ"}, {"Front.Position", "XYZ"}, {"Front.Normal", "XYZ"}, {"Back.UV", "UVA"}});
    names.push_back("Front.Depth.Z");
    const auto map = detect_roles(names);
    expect_channels(map, {{"normal.x", "Front.Normal.X"}, {"depth", "Front.Depth.Z"}});
    EXPECT_FALSE(map.has_role("uv"));
}

TEST(Roles, Mitsuba) {
    auto names = layers({{"pos", "XYZ"},
                         {"geo_normal", "XYZ"},
                         {"sh_normal", "XYZ"},
                         {"dp_du", "XYZ"},
                         {"dd", "T"},
                         {"coords", "UV"},
                         {"duv_dx", "UV"},
                         {"which", "I"},
                         {"prim_index", "I"}});
    names.insert(names.end(), {"R", "G", "B"});
    const auto map = detect_roles(names);
    EXPECT_EQ(map.writer, Writer::mitsuba);
    EXPECT_EQ(map.depth, DepthKind::ray);
    expect_channels(map, {{"position.x", "pos.X"},
                          {"normal.x", "sh_normal.X"},
                          {"depth", "dd.T"},
                          {"uv.v", "coords.V"},
                          {"duv_dx.u", "duv_dx.U"},
                          {"dp_du.z", "dp_du.Z"},
                          {"object", "which.I"},
                          {"beauty.g", "G"}});
}

TEST(Roles, Pbrt) {
    auto names = layers({{"P", "XYZ"}, {"N", "XYZ"}, {"Ns", "XYZ"}, {"Albedo", "RGB"}});
    names.insert(names.end(), {"R", "G", "B", "u", "v", "dudx", "dudy", "dvdx", "dvdy", "dzdx", "dzdy"});
    const auto map = detect_roles(names);
    EXPECT_EQ(map.writer, Writer::pbrt);
    expect_channels(map, {{"normal.x", "Ns.X"},
                          {"position.z", "P.Z"},
                          {"uv.u", "u"},
                          {"duv_dx.v", "dvdx"},
                          {"duv_dy.u", "dudy"},
                          {"albedo.r", "Albedo.R"}});
    EXPECT_FALSE(map.has_role("depth"));
}

TEST(Roles, RenderManKeepsCameraSpaceOut) {
    const auto map = detect_roles(layers(
        {{"__Pworld", "rgb"}, {"__Nworld", "rgb"}, {"__Nn", "rgb"}, {"__P", "rgb"}, {"__depth", "r"}, {"__st", "rg"}}));
    EXPECT_EQ(map.writer, Writer::renderman);
    expect_channels(
        map, {{"position.x", "__Pworld.r"}, {"normal.y", "__Nworld.g"}, {"depth", "__depth.r"}, {"uv.v", "__st.g"}});
    EXPECT_FALSE(detect_roles(layers({{"__Nn", "rgb"}, {"__P", "rgb"}})).has_role("normal"));
}

TEST(Roles, Arnold) {
    auto names = layers({{"P", "XYZ"}, {"N", "XYZ"}, {"crypto_object00", "RGBA"}, {"crypto_material00", "RGBA"}});
    names.insert(names.end(), {"Z", "R", "G", "B", "A"});
    const auto map = detect_roles(names);
    EXPECT_EQ(map.writer, Writer::arnold);
    expect_channels(map, {{"depth", "Z"}, {"normal.x", "N.X"}, {"crypto.coverage0", "crypto_object00.G"}});
    EXPECT_EQ(map.cryptomatte_layer, "crypto_object");
}

TEST(Roles, Unreal) {
    const std::string prefix = "FinalImageMovieRenderQueue_";
    auto names = Names{"R", "G", "B", prefix + "WorldDepth.R"};
    for (const char* c : {".R", ".G", ".B"}) names.push_back(prefix + "WorldNormal" + c);
    const auto map = detect_roles(names);
    EXPECT_EQ(map.writer, Writer::unreal);
    expect_channels(map, {{"normal.z", prefix + "WorldNormal.B"}, {"depth", prefix + "WorldDepth.R"}});
}

TEST(Roles, VRayNormalsAreScreenSpace) {
    auto names = layers({{"bump_normals", "XYZ"}});
    names.push_back("Z");
    const auto map = detect_roles(names);
    EXPECT_EQ(map.writer, Writer::vray);
    EXPECT_TRUE(map.camera_space_normals);
    EXPECT_FALSE(detect_roles(names, with_roles({{"normal", "none"}})).camera_space_normals);
}

TEST(Roles, HeadersOfVRayTellThatNormalsAreInCameraSpace) {
    const auto names = layers({{"normals", "XYZ"}, {"position", "XYZ"}});
    EXPECT_FALSE(detect_roles(names).camera_space_normals);
    Metadata header;
    header.set("vrayInfo/vrayversion", "Version of V-Ray for Maya 3.60.05");
    const auto hints = header_hints(header);
    EXPECT_EQ(detect_roles(names, {}, hints).writer, Writer::vray);
    EXPECT_TRUE(detect_roles(names, {}, hints).camera_space_normals);
    EXPECT_FALSE(detect_roles(layers({{"world_normal", "XYZ"}}), {}, hints).camera_space_normals);
    GBufferSource source;
    source.normals = NormalKind::sign;
    EXPECT_FALSE(detect_roles(names, source, hints).camera_space_normals);
    source.normals = NormalKind::camera;
    EXPECT_TRUE(detect_roles(names, source).camera_space_normals);
}

TEST(Roles, TwoViewLayersWithTheSamePassesAreAskedFor) {
    const auto names = layers({{"Hero.Normal", "XYZ"},
                               {"Hero.Position", "XYZ"},
                               {"Set.Normal", "XYZ"},
                               {"Set.Position", "XYZ"},
                               {"Set.Fog", "Z"}});
    expect_mentions(error_of([&] { detect_roles(names); }), {"\"Hero\" and \"Set\"", "[gbuffer] layer = \"Hero\""});
    GBufferSource source;
    source.layer = "Set";
    expect_channels(detect_roles(names, source), {{"normal.x", "Set.Normal.X"}, {"position.z", "Set.Position.Z"}});
    source.layer = "Sets";
    expect_mentions(error_of([&] { detect_roles(names, source); }), {"no view layer \"Sets\"", "\"Hero\", \"Set\""});
    expect_channels(detect_roles(names, with_roles({{"normal", "Set.Normal"}})), {{"normal.x", "Set.Normal.X"}});
}

TEST(Roles, ALayerWithThePassesOfTheBareOnesIsAskedFor) {
    const auto names = layers({{"N", "XYZ"}, {"P", "XYZ"}, {"B.N", "XYZ"}, {"B.P", "XYZ"}});
    expect_mentions(error_of([&] { detect_roles(names); }), {"\"B\" has the same passes as those without a layer"});
    GBufferSource source;
    source.layer = "B";
    expect_channels(detect_roles(names, source), {{"normal.x", "B.N.X"}, {"position.z", "B.P.Z"}});
    expect_channels(detect_roles(layers({{"", "RGB"}, {"B.N", "XYZ"}, {"B.P", "XYZ"}})), {{"normal.x", "B.N.X"}});
}

TEST(Roles, ADotInACryptomattesNameIsNoViewLayer) {
    const auto names = layers({{"N", "XYZ"}, {"my.id00", "RGBA"}, {"my.id01", "RGBA"}});
    Metadata header;
    header.set("cryptomatte/1234567/name", "my.id");
    EXPECT_EQ(detect_roles(names, {}, header_hints(header)).cryptomatte_layer, "my.id");
}

TEST(Roles, CryptomattesByTheHeadersNamesInWhateverOrder) {
    const auto names = layers({{"Z", "R"}, {"ids02", "RGBA"}, {"ids00", "RGBA"}, {"ids01", "RGBA"}, {"ids04", "RGBA"}});
    EXPECT_FALSE(detect_roles(names).has_role("cryptomatte"));
    Metadata header;
    header.set("cryptomatte/1234567/name", "ids");
    const auto map = detect_roles(names, {}, header_hints(header));
    EXPECT_EQ(map.cryptomatte_layer, "ids");
    EXPECT_EQ(map.cryptomatte_ranks, 6);
    expect_channels(map, {{"crypto.id0", "ids00.R"}, {"crypto.id2", "ids01.R"}, {"crypto.coverage5", "ids02.A"}});
    EXPECT_EQ(detect_roles(names, with_roles({{"cryptomatte", "ids"}}), header_hints(header)).cryptomatte_ranks, 6);
}

TEST(Roles, MitsubasTextureCoordinatesGrowDownwards) {
    const auto names = layers({{"sh_normal", "XYZ"}, {"uv", "UV"}, {"dd", "T"}});
    EXPECT_TRUE(detect_roles(names).v_down);
    EXPECT_FALSE(detect_roles(layers({{"N", "XYZ"}, {"uv", "UV"}})).v_down);
    GBufferSource source;
    source.v = VDirection::up;
    EXPECT_FALSE(detect_roles(names, source).v_down);
    Metadata header;
    header.set("generatedBy", "Mitsuba version 3.9.1");
    const auto by_header = detect_roles(layers({{"nn", "XYZ"}, {"uv", "UV"}}), {}, header_hints(header));
    EXPECT_TRUE(by_header.v_down);
    EXPECT_EQ(by_header.writer, Writer::mitsuba);
}

TEST(Roles, OwnPlaneNames) {
    Names names;
    for (const auto& role : gbuffer_roles()) {
        if (role.name != "cryptomatte") names.insert(names.end(), role.planes.begin(), role.planes.end());
    }
    const auto map = detect_roles(names);
    for (const auto& name : names) EXPECT_EQ(map.channel_of.at(name), name);
}

TEST(Roles, OverridesByLayerChannelAndPlane) {
    const auto map = detect_roles(blender_channels, with_roles({{"normal", "ViewLayer.Position"},
                                                                {"depth", "ViewLayer.UV.A"},
                                                                {"uv.v", "ViewLayer.UV.A"},
                                                                {"object", "none"},
                                                                {"cryptomatte", "CryptoObject"}}));
    expect_channels(map, {{"normal.x", "ViewLayer.Position.X"},
                          {"depth", "ViewLayer.UV.A"},
                          {"uv.u", "ViewLayer.UV.U"},
                          {"uv.v", "ViewLayer.UV.A"}});
    EXPECT_FALSE(map.has_role("object"));
}

TEST(Roles, OverridesThatMatchNothingNameTheNearest) {
    expect_mentions(error_of([] {
                        detect_roles(blender_channels, with_roles({{"normal", "ViewLayer.Norml"}}));
                    }),
                    {"normal = \"ViewLayer.Norml\"", "nearest name: \"ViewLayer.Normal\"", "ViewLayer.Position.XYZ"});
    expect_mentions(error_of([] {
                        detect_roles(blender_channels, with_roles({{"norml", "x"}}));
                    }),
                    {"\"norml\" is not a role", "nearest: \"normal\""});
    expect_mentions(error_of([] {
                        detect_roles(blender_channels, with_roles({{"normal", "ViewLayer.Depth.Z"}}));
                    }),
                    {"needs 3 components"});
    expect_mentions(error_of([] {
                        detect_roles(blender_channels, with_roles({{"cryptomatte", "CryptoMaterial"}}));
                    }),
                    {"nearest name: \"ViewLayer.CryptoObject\""});
}

}  // namespace
}  // namespace wrinkle
