#include "scene/light_json.h"

#include "tests/fuzz/fuzz.h"

/// A frame's own file of lights, as a scene reads it. What is wrong with one light goes to the document's problems.
WRINKLE_HARNESS(light_json_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".json", [](const std::filesystem::path& file) {
        wrinkle::scene::Document document{file.parent_path(), true, wrinkle::Problems("")};
        const toml::table lighting;
        wrinkle::scene::Table table(document, lighting, "[lighting]", 1);
        std::vector<wrinkle::Light> lights;
        wrinkle::scene::read_light_json(table, "lights", file, lights);
        document.problems.throw_if_any();
    });
}
