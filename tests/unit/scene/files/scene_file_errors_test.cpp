// SPDX-License-Identifier: MIT
// Every mistake in a scene file is one clear error that names the file, the line and the field.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/core/error.h"
#include "framework/image/image.h"
#include "framework/scene/files/scene_file.h"
#include "tests/unit/scene/files/scene_file_fixture.h"

namespace kaustik::scene {
namespace {

using test::SceneFile;

struct Mistake {
    std::string text;
    int line;
    std::vector<std::string> parts;
};

class SceneFileMistakes : public SceneFile {
  protected:
    void expect(const std::vector<Mistake>& mistakes) const {
        for (const Mistake& mistake : mistakes) {
            SCOPED_TRACE(mistake.text);
            const std::string message = messageOf<ConfigError>(mistake.text);
            const std::string place =
                fmt::format("{}:{}: ", (folder / "scene.toml").string(), mistake.line);
            EXPECT_TRUE(message.starts_with(place)) << message;
            for (const std::string& part : mistake.parts) {
                EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks " << part;
            }
            EXPECT_TRUE(message.ends_with('.') || message.ends_with('?')) << message;
        }
    }
};

TEST_F(SceneFileMistakes, AtTheTopLevel) {
    expect({
        {"name = ", 1, {"not valid TOML"}},
        {"name = 'a'\n\nname = 'b'", 3, {"not valid TOML"}},
        {"name = 'a'\n[camera", 2, {"not valid TOML"}},
        {"name = 3", 1, {"name must be text, not 3"}},
        {"\n\ndescritpion = 'x'", 3, {"'descritpion' is not a key", "did you mean 'description'?"}},
        {"[[materials]]\nname='m'", 1, {"'materials' is not a key", "'material'"}},
        {"qqqqqqqqqqqq = 1", 1, {"the keys are", "background_radiance"}},
        {"[light]\nname='l'", 1, {"light must be a list of tables, [[light]]"}},
        {"light = [1]", 1, {"light must be a list of tables"}},
        {"[[camera]]\nposition=[0,0,0]", 1, {"camera must be one table, [camera]"}},
        {"background_radiance = -1", 1, {"background_radiance must be at least 0", "not -1"}},
        {"background_radiance = [1, 2]", 1, {"a number or a list of 3 numbers, not a list of 2"}},
        {"background_radiance = [1, 2, '3']", 1, {"must be a number, not '3'"}},
        {"ambient_irradiance = inf", 1, {"ambient_irradiance", "inf"}},
        {"time = nan", 1, {"time", "nan"}},
        {"time = true", 1, {"time must be a number, not true"}},
        {"time = 1979-05-27", 1, {"time must be a number, not a date or time"}},
        {"[medium]\nanisotropy = 1", 2, {"anisotropy", "greater than -1 and less than 1"}},
        {"[medium]\nscattering_per_meter = -0.1", 2, {"scattering_per_meter", "at least 0"}},
        {"[medium]\nabsorbtion_per_meter = 1", 2, {"did you mean 'absorption_per_meter'?"}},
    });
}

TEST_F(SceneFileMistakes, InTheCamera) {
    const std::string head = "[camera]\nposition = [0, 0, 5]\n";
    expect({
        {"[camera]\ntarget = [0, 0, 0]", 1, {"camera: 'position' is missing"}},
        {"[camera]\npositoin = [0, 0, 0]", 2, {"'positoin'", "did you mean 'position'?"}},
        {head + "target = [0, 0, 5]", 3, {"target must differ from position"}},
        {head + "up = [0, 0, 0]", 3, {"up must not be the zero vector"}},
        {head + "up = [0, 0, 3]", 3, {"up must not be parallel"}},
        {head + "target = 3", 3, {"a list of 3 numbers, not 3"}},
        {head + "vertical_fov_degrees = 0", 3, {"greater than 0 and less than 180", "not 0"}},
        {head + "vertical_fov_degrees = 180", 3, {"greater than 0 and less than 180"}},
        {head + "near = 0", 3, {"near must be at least", "not 0"}},
        {head + "near = -1", 3, {"near must be at least"}},
        {head + "near = 1e300", 3, {"near must be at least", "1e+300"}},
        {head + "far = 100", 3, {"camera: 'far' is not a key"}},
    });
}

TEST_F(SceneFileMistakes, InALight) {
    const std::string sun = "[[light]]\nname = 'sun'\ntype = 'directional'\n";
    const std::string lamp = "[[light]]\nname = 'lamp'\ntype = 'point'\nposition = [0, 1, 0]\n";
    const std::string spot =
        "[[light]]\nname='s'\ntype='spot'\nposition=[0,1,0]\ndirection=[0,-1,0]\nintensity=1\n";
    expect({
        {"[[light]]\ntype = 'point'\nposition = [0, 0, 0]\nintensity = 1",
         1,
         {"'name' is missing"}},
        {"[[light]]\nname = ''\ntype = 'point'", 2, {"name must not be empty"}},
        {"[[light]]\nname = 'sun'", 1, {"light 'sun': 'type' is missing"}},
        {"[[light]]\nname = 'sun'\ntpye = 'point'", 3, {"'tpye'", "did you mean 'type'?"}},
        {"[[light]]\nname = 'sun'\ntype = 'piont'",
         3,
         {"type 'piont' is not one of directional, point and spot", "did you mean 'point'?"}},
        {sun + "irradiance = 1", 1, {"light 'sun': 'direction' is missing"}},
        {sun + "direction = [0, -1, 0]", 1, {"'irradiance' is missing"}},
        {sun + "direction = [0, 0, 0]\nirradiance = 1", 4, {"direction must not be the zero"}},
        {sun + "direction = [0, -1, nan]\nirradiance = 1", 4, {"direction must be", "nan"}},
        {sun + "direction = [0, -1, 0]\nirradiance = -1", 5, {"irradiance must be at least 0"}},
        {sun + "direction = [0, -1, 0]\nirradiance = 1\ncolor = [1, -1, 1]", 6, {"color"}},
        {sun + "direction = [0, -1, 0]\nirradiance = 1\nrange = 2", 6, {"'range' is not a key"}},
        {lamp + "irradiance = 3", 5, {"'irradiance' is not a key"}},
        {lamp, 1, {"'intensity' is missing"}},
        {lamp + "intensity = 1\npower_watts = 1", 6, {"either intensity or power_watts"}},
        {lamp + "intensity = 1\nrange = -1", 6, {"range must be at least 0"}},
        {spot + "outer_cone_degrees = 0", 7, {"outer_cone_degrees", "greater than 0"}},
        {spot + "outer_cone_degrees = 91", 7, {"outer_cone_degrees", "at most 90"}},
        {spot + "inner_cone_degrees = 50", 7, {"at most outer_cone_degrees (45), not 50"}},
        {lamp + "intensity = 1\ntexture = 'scene.toml'", 6, {"'texture' is not a key"}},
        {spot + "up = [0, 0, 1]", 7, {"'up' is not a key"}},
        {spot + "texture = 'scene.toml'\nup = [0, 1, 0]", 8, {"up must not be parallel"}},
        {spot + "texture = 'scene.toml'\nouter_cone_degrees = 90",
         7,
         {"outer_cone_degrees of at most 89, not 90"}},
        {lamp + "intensity = 1\n" + lamp + "intensity = 2", 7, {"light 'lamp'", "used twice"}},
    });
}

TEST_F(SceneFileMistakes, InAMaterial) {
    const std::string head = "[[material]]\nname = 'm'\n";
    expect({
        {head + "type = 'glassy'\nalbedo = 1",
         3,
         {"lambertian, dielectric, mirror and glossy", "did you mean 'glossy'?"}},
        {head + "type = 'lambertian'", 1, {"material 'm': 'albedo' is missing"}},
        {head + "type = 'lambertian'\nalbedo = 1.5",
         4,
         {"albedo must be at least 0 and at most 1"}},
        {head + "type = 'lambertian'\nalbedo = [0, -0.1, 0]", 4, {"albedo", "not -0.1"}},
        {head + "type = 'lambertian'\nalbedo = 1\npattern = 'tile'", 5, {"did you mean 'tiles'?"}},
        {head + "type = 'lambertian'\nalbedo = 1\npattern_albedo = 2", 5, {"pattern_albedo"}},
        {head + "type = 'lambertian'\nalbedo = 1\nuv_scale = 0", 5, {"uv_scale", "not 0"}},
        {head + "type = 'lambertian'\nalbedo = 1\nuv_scale = [1,2,3]", 5, {"a list of 3"}},
        {head + "type = 'lambertian'\nalbedo = 1\nior = 1.5", 5, {"'ior' is not a key"}},
        {head + "type = 'lambertian'\nalbedo = 1\nspecular = 0", 5, {"'specular' is not a key"}},
        {head + "type = 'lambertian'\nalbedo = 1\nnormal_map = 'a.png'",
         5,
         {"'normal_map' is not a key"}},
        {head + "type = 'mirror'\nnormal_scale = 2", 4, {"'normal_scale' is not a key"}},
        {head + "type = 'dielectric'\nior = 1.5\nglass = 'water'",
         1,
         {"one of ior, cauchy, sellmeier and glass is given"}},
        {head + "type = 'dielectric'\nsellmeier = {b = [1, 1, 1]}", 4, {"'c' is missing"}},
        {head + "type = 'dielectric'\nsellmeier = {b = [1, 1, 1], c = [0.3, 0, 0]}",
         4,
         {"sellmeier makes the index of refraction less than 1"}},
        {head + "type = 'dielectric'\nglass = 'N-BK8'", 4, {"did you mean 'N-BK7'"}},
        {head + "type = 'dielectric'\nglass = 'water'\nabbe_number = 30",
         5,
         {"'abbe_number' is not a key"}},
        {head + "type = 'dielectric'\ncauchy = [0.9, 0.001, 0]",
         4,
         {"cauchy makes the index of refraction less than 1"}},
        {head + "type = 'glossy'\nalbedo = 1", 1, {"'specular' is missing"}},
        {head + "type = 'glossy'\nalbedo = 0.5\nspecular = 1.5", 5, {"specular", "at most 1"}},
        {head + "type = 'glossy'\nalbedo = [0.2, 0.75, 0]\nspecular = 0.5",
         5,
         {"albedo and specular must add up to at most 1, not 1.25"}},
        {head + "type = 'glossy'\nalbedo = 0\nspecular = 0.8\npattern = 'tiles'",
         5,
         {"pattern_albedo and specular must add up to at most 1, not 1.05"}},
        {head + "type = 'glossy'\nalbedo = 0\nspecular = 0\nexponent = 0.5",
         6,
         {"exponent must be at least 1", "not 0.5"}},
        {head + "type = 'dielectric'", 1, {"'ior' is missing"}},
        {head + "type = 'dielectric'\nior = 0", 4, {"ior must be at least 1", "not 0"}},
        {head + "type = 'dielectric'\nior = -2", 4, {"ior must be at least 1"}},
        {head + "type = 'dielectric'\nior = 0.999", 4, {"ior must be at least 1"}},
        {head + "type = 'dielectric'\nior = inf", 4, {"ior must be at least 1", "inf"}},
        {head + "type = 'dielectric'\nior = 1.5\nabsorption_per_meter = -1", 5, {"absorption"}},
        {head + "type = 'mirror'\nreflectance = 2", 4, {"reflectance must be", "at most 1"}},
        {head + "type = 'mirror'\n" + head + "type = 'mirror'", 5, {"material 'm'", "used twice"}},
    });
}

TEST_F(SceneFileMistakes, InAnObject) {
    const std::string white =
        "[[material]]\nname = 'white'\ntype = 'lambertian'\nalbedo = 1\n";  // 4 lines
    const std::string head = white + "[[object]]\nname = 'o'\nmaterial = 'white'\n";
    const std::string ball = head + "shape = 'sphere'\nradius = 1\n";
    expect({
        {"[[object]]\nname='o'\nmaterial='m'\nshape='sphere'\nradius=1", 3, {"no [[material]]"}},
        {white + "[[object]]\nname='o'\nmaterial='whtie'\nshape='sphere'\nradius=1",
         7,
         {"object 'o'", "'whtie' is not one of white", "did you mean 'white'?"}},
        {white + "[[object]]\nname='o'\nshape='sphere'\nradius=1", 5, {"'material' is missing"}},
        {head, 5, {"object 'o': 'shape' is missing"}},
        {head + "shape = 'shpere'\nradius = 1", 8, {"'shpere' is not one of", "'sphere'?"}},
        {head + "shape = 'sphere'\nmesh = 'a.obj'", 8, {"either mesh or shape"}},
        {ball + "scale = 0", 10, {"scale must be at least", "not 0"}},
        {ball + "scale = [1, -1, 1]", 10, {"scale must be at least", "not -1"}},
        {ball + "position = [1, 2]", 10, {"position must be a list of 3 numbers"}},
        {ball + "position = [1, 2, 1e20]", 10, {"position must be", "1e+20"}},
        {ball + "rotation_degrees = 90", 10, {"rotation_degrees must be a list of 3"}},
        {ball + "fit = {height = 1}", 10, {"'fit' is not a key"}},
        {ball + "hieght = 1", 10, {"'hieght' is not a key"}},
        {ball + "[[object]]\nname = 'o'\nmaterial = 'white'\nshape = 'sphere'\nradius = 1",
         11,
         {"object 'o'", "used twice"}},
    });
}

TEST_F(SceneFileMistakes, InAShape) {
    const std::string head =
        "[[material]]\nname='m'\ntype='lambertian'\nalbedo=1\n[[object]]\nname='o'\nmaterial='m'\n";
    const std::string water = head + "shape='water'\nsize=[1,1]\n";
    const std::string lens = head + "shape='lens'\ntop_radius=1\nbottom_radius=1\ndiameter=1\n";
    expect({
        {head + "shape='sphere'\nradius=-1", 9, {"radius must be at least", "not -1"}},
        {head + "shape='sphere'\nradius=0", 9, {"radius must be at least"}},
        {head + "shape='sphere'\nraduis=1", 9, {"'raduis'", "did you mean 'radius'?"}},
        {head + "shape='sphere'\nradius=1\nsegments=3", 10, {"segments", "from 4 to 2048, not 3"}},
        {head + "shape='sphere'\nradius=1\nsegments=99999", 10, {"segments", "2048"}},
        {head + "shape='sphere'\nradius=1\nsegments=8.5", 10, {"a whole number", "8.5"}},
        {head + "shape='plane'\nsize=[1,0]", 9, {"size must be at least"}},
        {head + "shape='plane'\nsize=1", 9, {"size must be a list of 2 numbers"}},
        {head + "shape='plane'\nsize=[1,1]\ncells=0", 10, {"cells", "from 1 to 2048, not 0"}},
        {head + "shape='plane'\nsize=[1,1]\ncells=[1,2,3]", 10, {"one or two whole numbers"}},
        {head + "shape='box'\nsize=[1,1,1]\nopen='+y'", 10, {"open must be a list of texts"}},
        {head + "shape='box'\nsize=[1,1,1]\nopen=[1]", 10, {"open must hold texts only"}},
        {head + "shape='box'\nsize=[1,1,1]\nopen=['y']", 10, {"'y' is not one of -x, +x, -y"}},
        {head + "shape='box'\nsize=[1,1,1]\nopen=['-x','+x','-y','+y','-z','+z']",
         8,
         {"at least one face"}},
        {head + "shape='box'\nsize=[1,1,1]\ninward=1", 10, {"inward must be true or false"}},
        {head + "shape='ring'\ninner_radius=2\nouter_radius=1\nheight=1",
         8,
         {"object 'o'", "inner_radius must be less than outer_radius (1), not 2"}},
        {head + "shape='ring'\nouter_radius=1\nheight=1", 5, {"'inner_radius' is missing"}},
        {head + "shape='torus'\nradius=1\ntube_radius=1", 8, {"tube_radius must be less"}},
        {lens, 8, {"Exactly one of center_thickness and edge_thickness"}},
        {lens + "center_thickness=0.1", 8, {"center_thickness must be greater than", "cross"}},
        {lens + "edge_thickness=0", 12, {"edge_thickness must be at least"}},
        {head + "shape='lens'\ntop_radius=0.3\nbottom_radius=1\ndiameter=1\nedge_thickness=1",
         8,
         {"top_radius must be 0 (flat) or at least half the diameter (0.5)"}},
        {head + "shape='prism'\napex_degrees=180\nheight=1\nlength=1", 9, {"less than 180"}},
        {head + "shape='paraboloid'\nfocal_length=0\ndiameter=1", 9, {"focal_length"}},
        {water + "cells=[4096, 4096]", 10, {"cells", "from 1 to 2048, not 4096"}},
        {water + "cells=-1", 10, {"cells"}},
        {water + "waves=[{amplitude=1, wavelength=0}]", 10, {"waves: wavelength", "not 0"}},
        {water + "waves=[{amplitude=-1, wavelength=1}]", 10, {"amplitude must be at least 0"}},
        {water + "waves=[{wavelength=1}]", 10, {"'amplitude' is missing"}},
        {water + "waves=[{amplitude=1, wavelenght=1}]", 10, {"did you mean 'wavelength'?"}},
        {water + "waves=[1]", 10, {"waves must be a list of tables"}},
        {water + "waves=[]\n[[object.wave]]\namplitude=1\nwavelength=1", 11, {"not both"}},
        {water + "[[object.wave]]\namplitude=1\nwavelength=1\nomega=-1", 13, {"omega"}},
    });
}

TEST_F(SceneFileMistakes, InHowAMeshIsFitted) {
    write("t.obj", test::kTetrahedron);
    write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n");
    const std::string head =
        "[[material]]\nname='m'\ntype='lambertian'\nalbedo=1\n[[object]]\nname='o'\nmaterial='m'\n";
    expect({
        {head + "mesh='t.obj'\nfit=1", 9, {"fit must be one table"}},
        {head + "mesh='t.obj'\nfit={}", 9, {"fit must be {height = …} or {size = …}"}},
        {head + "mesh='t.obj'\nfit={height=1,size=1}", 9, {"fit must be {height"}},
        {head + "mesh='t.obj'\nfit={hieght=1}", 9, {"'hieght'", "did you mean 'height'?"}},
        {head + "mesh='t.obj'\nfit={height=0}", 9, {"height must be at least"}},
        {head + "mesh='t.obj'\nfit={height=1}\nscale=2", 9, {"either fit or scale"}},
        {head + "mesh='t.obj'\nrest_on=nan", 9, {"rest_on must be"}},
        {head + "mesh='t.obj'\nradius=1", 9, {"'radius' is not a key"}},
        {head + "mesh='flat.obj'\nfit={height=1}", 9, {"no extent"}},
    });
}

TEST_F(SceneFileMistakes, AMissingMeshSaysWhereItWasSoughtAndWhatToDo) {
    ::setenv("KAUSTIK_MESHES", "/nowhere/meshes", 1);
    const std::string message = messageOf<IoError>(
        "[[material]]\nname='m'\ntype='lambertian'\nalbedo=1\n"
        "[[object]]\nname='rabbit'\nmaterial='m'\nmesh='no-such-mesh.obj'\n");
    ::unsetenv("KAUSTIK_MESHES");
    EXPECT_TRUE(message.starts_with((folder / "scene.toml").string() + ":8: ")) << message;
    EXPECT_NE(message.find("mesh 'no-such-mesh.obj' was not found in "), std::string::npos);
    EXPECT_NE(message.find("put it there, or name its folder in KAUSTIK_MESHES"),
              std::string::npos);
    EXPECT_NE(message.find("rabbit"), std::string::npos);
    EXPECT_NE(message.find(folder.string() + ","), std::string::npos);
    EXPECT_NE(message.find((projectRoot() / "meshes").string()), std::string::npos);
    EXPECT_NE(message.find("/nowhere/meshes"), std::string::npos);
}

TEST_F(SceneFileMistakes, InvalidNormalMap) {
    const std::string text = "[[material]]\nname='m'\ntype='mirror'\nnormal_map='map.pfm'\n";
    EXPECT_NE(messageOf<IoError>(text).find("scene.toml:4: material 'm': the normal_map"),
              std::string::npos);
    Image picture(4, 4, 3);
    for (int i = 0; i < 16; ++i)
        picture.at(i % 4, i / 4, 0) = 0.5f;  // black but for red: into the surface
    writeImage(folder / "map.pfm", picture);
    const std::string message = messageOf<IoError>(text);
    EXPECT_NE(message.find("scene.toml:4: material 'm': "), std::string::npos) << message;
    EXPECT_NE(message.find("map.pfm is no normal map: 0% of its texels"), std::string::npos)
        << message;
}

TEST_F(SceneFileMistakes, AMissingTextureOrFileIsNamed) {
    const std::string message = messageOf<IoError>(
        "[[material]]\nname='m'\ntype='lambertian'\nalbedo=1\ntexture='no.png'\n");
    EXPECT_NE(message.find("scene.toml:5: material 'm': the texture"), std::string::npos);
    EXPECT_NE(message.find("no.png"), std::string::npos);
    EXPECT_THROW((void)loadSceneFile(folder / "absent.toml"), IoError);
    EXPECT_THROW((void)loadSceneFile(folder), IoError);
}

TEST_F(SceneFileMistakes, ShapesThatTakeAllOfTheMemoryAreAnError) {
    std::string text = "[[material]]\nname = 'm'\ntype = 'mirror'\n";
    for (int i = 0; i < 5; ++i) {
        text += fmt::format(
            "[[object]]\nname = '{}'\nmaterial = 'm'\nshape = 'plane'\nsize = [1, 1]\n"
            "cells = 2048\n",
            i);
    }
    const std::string message = messageOf<ConfigError>(text);
    EXPECT_NE(message.find("scene.toml:31: object '4': with this shape the scene has 41943040"),
              std::string::npos)
        << message;
}

TEST_F(SceneFileMistakes, CutOffOrDamagedAtAnyByteIsAnErrorOfOursOrASmallerScene) {
    const std::string whole =
        "name = 'x'\n[camera]\nposition = [0, 1, 2]\n[[light]]\nname = 'l'\ntype = 'point'\n"
        "position = [0, 1, 0]\nintensity = 2.5\n[[material]]\nname = 'm'\ntype = 'dielectric'\n"
        "ior = 1.5\n[[object]]\nname = 'o'\nmaterial = 'm'\nshape = 'water'\nsize = [1, 1]\n"
        "cells = 2\nwaves = [{amplitude = 0.1, wavelength = 1}]\n";
    EXPECT_EQ(load(whole).objects.size(), 1u);
    int rejected = 0;
    const auto tryToLoad = [&](const std::string& text) {
        try {
            (void)load(text);
        } catch (const ConfigError&) {
            ++rejected;
        }  // anything else ends the test
    };
    for (std::size_t i = 0; i < whole.size(); ++i) {
        tryToLoad(whole.substr(0, i));
        for (const char damage : {'\0', '"', '9', '\xff'}) {
            std::string damaged = whole;
            damaged[i] = damage;
            tryToLoad(damaged);
        }
    }
    EXPECT_GT(rejected, static_cast<int>(whole.size()));
}

}  // namespace
}  // namespace kaustik::scene
