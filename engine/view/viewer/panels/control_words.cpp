#include <algorithm>
#include <iterator>

#include "palpate/base/language.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

struct ControlRow {
  std::string_view path;  ///< one that ends in / is for everything below it
  std::string_view words;
};

// clang-format off
constexpr ControlRow kControlWords[] = {
    // menus
    {"menu/File", toTranslate("Open, save, pictures and films, measuring, a class.")},
    {"menu/View", toTranslate("Camera, panels, plots, theme, size of the letters.")},
    {"menu/Show", toTranslate("What is drawn on and in the skin.")},
    {"menu/Help", toTranslate("Keys, the manual, messages.")},
    {"menu/Start page", toTranslate("Touch, train, open, measure, run a class, and examples with pictures.")},
    {"menu/Recent", toTranslate("Recently opened files, newest first.")},
    {"menu/recent file", toTranslate("Open it again.")},
    {"menu/Examples", toTranslate("Example scenes.")},
    {"menu/Class", toTranslate("Run a class on this computer, watch one, or take part in one.")},
    {"menu/Save picture", toTranslate("Save a picture (PNG) under a name that you choose.")},
    {"menu/Save film", toTranslate("Film the window into a WebM or GIF file, 20 pictures a second.")},
    {"menu/Stop the film", toTranslate("Finish the film and close its file.")},
    {"menu/Panel on the right", toTranslate("Put the side panel on the other side.")},
    {"menu/Copy the view", toTranslate("Copy the camera as text, to paste it later or elsewhere.")},
    {"menu/Paste the view", toTranslate("Fly to the copied camera.")},
    {"menu/Theme", toTranslate("Colours of the window: dark, light or high contrast.")},
    {"menu/Text size", toTranslate("Size of all letters and controls, 75 to 250 %.")},
    {"menu/Language", toTranslate("Language of this window, from the next start on.")},
    {"menu/Mouse", toTranslate("What the buttons do, and how fast the camera turns.")},
    {"menu/Swap left and right", toTranslate("Swap the mouse buttons, for left-handed use.")},
    {"menu/Invert the wheel", toTranslate("The wheel zooms the other way.")},
    {"menu/Reduced motion", toTranslate("The camera jumps instead of flying.")},
    {"menu/Reset the layout", toTranslate("Restore the original panels and text size.")},
    {"menu/Engine", toTranslate("Show what the contact search looks at.")},
    {"menu/Manual", toTranslate("All documents, offline, with search.")},
    {"menu/Hints", toTranslate("Show the hints at the lower edge again.")},
    {"menu/Messages", toTranslate("All messages since the start.")},
    // sections of the panel
    {"panel/Touch", toTranslate("How the mouse presses, and friction of the skin.")},
    {"panel/Devices", toTranslate("Haptic devices: open, calibrate, limits.")},
    {"panel/Tissue", toTranslate("Layers under the skin, stiffness, shape of the dent.")},
    {"panel/Dysfunctions", toTranslate("Places that are stiffer or softer.")},
    {"panel/Lumps", toTranslate("Lumps under the skin: nodes, cysts, hard bands.")},
    {"panel/Model", toTranslate("The body: its size, its file, its triangles.")},
    {"panel/Show", toTranslate("How the skin is drawn and coloured.")},
    {"panel/Vertex", toTranslate("Values at the place clicked last.")},
    {"panel/Stereo", toTranslate("A picture for each eye; a tracked head.")},
    {"panel/Record", toTranslate("Forces, pictures and recordings as files.")},
    {"panel/Performance", toTranslate("Rates (Hz), compute times and lateness (ms).")},
    // fields and buttons
    {"menu/place", toTranslate("A place by its name; Enter flies there (Ctrl+F).")},
    {"dysfunctions/place", toTranslate("Its position, a place or a distance in mm from one; Enter moves it there.")},
    {"places/", toTranslate("Fly there.")},
    {"dysfunctions/delete", toTranslate("Remove the selected place (Delete).")},
    {"dysfunctions/undo", toTranslate("Nothing to undo yet.")},
    {"dysfunctions/redo", toTranslate("Nothing to redo yet.")},
    {"lumps/place", toTranslate("Its position, a place or a distance in mm from one; Enter moves it there.")},
    {"lumps/delete", toTranslate("Remove the selected lump (Delete).")},
    {"lumps/undo", toTranslate("Nothing to undo yet.")},
    {"lumps/redo", toTranslate("Nothing to redo yet.")},
    {"devices/look", toTranslate("Look for devices again.")},
    {"open/file", toTranslate("A file or folder; Enter opens it.")},
    {"photograph/file", toTranslate("A photograph or folder; Enter opens it.")},
    {"save/file", toTranslate("A name; Enter saves.")},
    {"picture/file", toTranslate("A name that ends in .png; Enter saves.")},
    {"film/file", toTranslate("A name that ends in .webm or .gif; Enter begins the film.")},
    {"files/", toTranslate("Click to choose the file or open the folder.")},
    {"toast/dismiss", toTranslate("Dismiss this message; Help > Messages keeps it.")},
    {"building/cancel", toTranslate("Keep the body that is shown (Esc).")},
    {"stop/release", toTranslate("Allow device forces again.")},
    {"messages/copy", toTranslate("Copy all messages as text.")},
    {"question/", toTranslate("Enter gives the first answer, Esc the last.")},
    {"record/picture", toTranslate("Save a picture (PNG) under a new name, without menus and messages.")},
    {"record/csv", toTranslate("Save force, depth and speed from the plots as a table.")},
    {"record/scene", toTranslate("Save the scene with all changes, look and camera.")},
    {"show/fit", toTranslate("Fit the colours to the range of this body.")},
    {"show/all_the_same", toTranslate("Keep the chosen shading even if pictures are slow.")},
    {"show/engine", toTranslate("Overlays of the engine: boxes, planes, triangles.")},
    {"model/default", toTranslate("Return to the built-in trunk.")},
    {"plots/window", toTranslate("How many seconds the plots show.")},
    {"replay/moment", toTranslate("Drag to another time in the recording (s).")},
    {"tissue/curve", toTranslate("The dent's shape from its middle to its edge; drag the handles of your own curve.")},
    {"start/", toTranslate("Click to begin.")},
    {"manual/contents", toTranslate("The list of all pages.")},
    {"manual/back", toTranslate("The previous page.")},
    {"manual/search", toTranslate("Words to find; pages with all of them are listed, Enter opens the first.")},
    {"manual/close", toTranslate("Back to the body (Esc).")},
    {"class/folder", toTranslate("Folder of the class on this computer; an existing class is started again.")},
    {"class/name", toTranslate("Name of the class in messages: letters, digits and hyphens.")},
    {"class/computer", toTranslate("Name or address at which stations reach this computer; localhost to try it here.")},
    {"class/start", toTranslate("Make the folder with a key for each station, start broker and collector, open the teacher's window.")},
    {"class/end", toTranslate("Stations keep their results and send them next time.")},
    {"class/watched", toTranslate("Folder of the class, or instructor folder that you were given.")},
    {"class/watch", toTranslate("Watch every station live, those that need help first.")},
    {"class/station", toTranslate("The folder that you were given: stations/s01 of the class.")},
    {"class/join", toTranslate("Train at this station; results go to the class.")},
};
// clang-format on

/// Text of the engine that is shown unchanged: steps of a build, safety rules, choices of keys and enumerations.
// clang-format off
[[maybe_unused]] constexpr const char* kEngineWords[] = {
    toTranslate("dark"), toTranslate("light"), toTranslate("high contrast"),  // window::kThemeNames
    toTranslate("Touch"), toTranslate("View"), toTranslate("Overlays"), toTranslate("Window"), toTranslate("File"),  // window::kKeyGroupNames
    toTranslate("opening"), toTranslate("laying the texture"), toTranslate("looking for self-intersections"),
    toTranslate("checking"), toTranslate("reading the texture coordinates"),
    toTranslate("building the contact surface"), toTranslate("building the torso"), toTranslate("building the back"),
    toTranslate("building the trunk"), toTranslate("building the fitted bones"),
    toTranslate("reusing a body made before"),
    toTranslate("ordering the triangles"), toTranslate("mapping stiffness"), toTranslate("preparing the deformation"),
    toTranslate("partitioning the skin"), toTranslate("fitting the build"), toTranslate("trying all ways round"),
    toTranslate("measuring"), toTranslate("tip not finite"), toTranslate("tip jumped"),
    toTranslate("force not finite"), toTranslate("force ramps up"), toTranslate("damped"),
    toTranslate("force clamped"), toTranslate("force jumped"), toTranslate("loop stalled"), toTranslate("tip stale"),
    toTranslate("held back"), toTranslate("soft contact"), toTranslate("emergency stop"), toTranslate("too stiff"),
    toTranslate("clutched"), toTranslate("corrected"), toTranslate("literal"), toTranslate("left"),
    toTranslate("right"), toTranslate("trunk"), toTranslate("torso"), toTranslate("back"), toTranslate("mesh"),
    toTranslate("standing"), toTranslate("prone"), toTranslate("sitting"), toTranslate("auto"), toTranslate("depth"),
    toTranslate("points"), toTranslate("constant"), toTranslate("surface"), toTranslate("linear"),
    toTranslate("power"), toTranslate("stiffening"), toTranslate("table"), toTranslate("layered"),
    toTranslate("gaussian"), toTranslate("bsp"), toTranslate("octree"), toTranslate("leaves"),
    toTranslate("triangles"), toTranslate("coherent"), toTranslate("linked"), toTranslate("ellipse"),
    toTranslate("circle"), toTranslate("contour"), toTranslate("half_gaussian"), toTranslate("sharp"),
    toTranslate("cosine"), toTranslate("logarithm"), toTranslate("user"), toTranslate("above"), toTranslate("front"),
    toTranslate("below"), toTranslate("gouraud"), toTranslate("skin"), toTranslate("plain"), toTranslate("strain"),
    toTranslate("stiffness"), toTranslate("ellipses"), toTranslate("scalar"), toTranslate("finger"),
    toTranslate("hand"), toTranslate("ball"), toTranslate("none"), toTranslate("mono"), toTranslate("sbs-half"),
    toTranslate("sbs-full"), toTranslate("sbs-cross"), toTranslate("tb-half"), toTranslate("tb-full"),
    toTranslate("anaglyph-grey"), toTranslate("anaglyph-dubois"), toTranslate("anaglyph-half"),
    toTranslate("interlaced"), toTranslate("two_gaussians"), toTranslate("two_mm"), toTranslate("hdb"),
    toTranslate("analytic"), toTranslate("recomputed"), toTranslate("incremental"), toTranslate("edges"),
    toTranslate("principal"), toTranslate("dry"), toTranslate("oiled"), toTranslate("quad-buffer"),
    toTranslate("force"), toTranslate("up"), toTranslate("down"), toTranslate("neighbours"), toTranslate("cyclic"),
    toTranslate("zero"), toTranslate("smooth"), toTranslate("lowered"), toTranslate("step"), toTranslate("nearest"),
    toTranslate("cubic"), toTranslate("solved"), toTranslate("summed"), toTranslate("outside"), toTranslate("ramp"),
    toTranslate("shared"), toTranslate("scaled"),
};
// clang-format on

}  // namespace

std::string_view controlTooltip(std::string_view path) {
  const auto row = std::find_if(std::begin(kControlWords), std::end(kControlWords), [&](const ControlRow& r) {
    return r.path.ends_with('/') ? path.starts_with(r.path) : path == r.path;
  });
  return row == std::end(kControlWords) ? std::string_view() : row->words;
}

}  // namespace palpate::viewer
