#include <algorithm>
#include <iterator>

#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

struct ControlRow {
  std::string_view path;  ///< one that ends in / is for all below it
  std::string_view words;
};

// clang-format off
constexpr ControlRow kControlWords[] = {
    // menus
    {"menu/File", "Open, save, pictures and films, measuring, a class."},
    {"menu/View", "Camera, panels, plots, theme, size of the letters."},
    {"menu/Show", "What is drawn on the skin and in it."},
    {"menu/Help", "Keys, the manual, messages."},
    {"menu/Start page", "Touch, train, open, measure, a class, and ready examples with pictures."},
    {"menu/Recent", "Files that were opened last, the newest first."},
    {"menu/recent file", "Opens it again."},
    {"menu/Examples", "Ready scenes."},
    {"menu/Class", "Run a class on this computer, watch one, or take part in one."},
    {"menu/Save picture", "Save a picture (PNG) under a name of your own."},
    {"menu/Save film", "Film the window into a WebM or GIF file, 20 pictures a second."},
    {"menu/Stop the film", "Finish the film; it is then whole."},
    {"menu/Panel on the right", "Put the side panel on the other side."},
    {"menu/Copy the view", "Copy the camera as text, to be pasted later or elsewhere."},
    {"menu/Paste the view", "Fly to the camera that was copied."},
    {"menu/Theme", "Colours of the window: dark, light or of high contrast."},
    {"menu/Text size", "Size of all letters and controls, 75 to 250 %."},
    {"menu/Mouse", "What the buttons do, and how fast the camera turns."},
    {"menu/Swap left and right", "For the left hand."},
    {"menu/Invert the wheel", "The wheel zooms the other way."},
    {"menu/Reduced motion", "The camera jumps instead of flying."},
    {"menu/Reset the layout", "Panels and letters as they were at first."},
    {"menu/Engine", "What the search for contact looks at."},
    {"menu/Manual", "All documents, offline, with search."},
    {"menu/Hints", "Begin the hints at the lower edge again."},
    {"menu/Messages", "Everything that was reported since the start."},
    // sections of the panel
    {"panel/Touch", "How the mouse presses, and friction of the skin."},
    {"panel/Devices", "Haptic devices: open, calibrate, limits."},
    {"panel/Tissue", "Layers under the skin, stiffness, shape of the dent."},
    {"panel/Dysfunctions", "Places that are stiffer or softer."},
    {"panel/Model", "The body: its size, its file, its triangles."},
    {"panel/Show", "How the skin is drawn and coloured."},
    {"panel/Vertex", "Numbers of the place that was clicked last."},
    {"panel/Stereo", "A picture for each eye; a tracked head."},
    {"panel/Record", "Forces, pictures and recordings as files."},
    {"panel/Performance", "How fast and how punctual everything is, in ms and Hz."},
    // fields and buttons
    {"menu/place", "A place by its name, such as T6 or left PSIS; Enter flies there (Ctrl+F)."},
    {"dysfunctions/place", "Where it lies, such as T9 left 51 mm; Enter moves it there."},
    {"places/", "Fly there."},
    {"dysfunctions/delete", "Remove the selected place (Delete)."},
    {"dysfunctions/undo", "Nothing to take back yet."},
    {"dysfunctions/redo", "Nothing to do again yet."},
    {"devices/look", "Look for devices once more."},
    {"open/file", "A file or folder; Enter opens it."},
    {"photograph/file", "A photograph or folder; Enter opens it."},
    {"save/file", "A name; Enter saves."},
    {"picture/file", "A name that ends in .png; Enter saves."},
    {"film/file", "A name that ends in .webm or .gif; Enter begins the film."},
    {"files/", "Click to take it or to go into it."},
    {"toast/dismiss", "Take this message away; Help > Messages keeps it."},
    {"building/cancel", "Keep the body that is shown (Esc)."},
    {"stop/release", "Devices get forces again."},
    {"messages/copy", "Copy all messages as text."},
    {"question/", "Enter is the first answer, Esc the last."},
    {"record/picture", "Save a picture (PNG) under a fresh name, without menus and messages."},
    {"record/csv", "Force, depth and speed that the plots show, as a table."},
    {"record/scene", "Save the scene with all changes, look and camera."},
    {"show/fit", "Let the colours span what this body has."},
    {"show/all_the_same", "Keep the chosen shading although pictures come slowly."},
    {"show/engine", "Overlays of the engine: boxes, planes, triangles."},
    {"model/default", "Back to the built-in trunk."},
    {"plots/window", "How many seconds the plots show."},
    {"replay/moment", "Drag to another moment of the recording, s."},
    {"tissue/curve", "The dent's shape from its middle to its edge; drag the handles of your own curve."},
    {"start/", "Click to begin."},
    {"manual/contents", "The list of all pages."},
    {"manual/back", "The page before."},
    {"manual/search", "Words; pages that hold all of them are listed, Enter opens the first."},
    {"manual/close", "Back to the body (Esc)."},
    {"class/folder", "Folder of the class on this computer; a class that is there is started again."},
    {"class/name", "What the class is called in messages: letters, digits and hyphens."},
    {"class/computer", "Name or address under which the stations reach this computer; localhost for a trial here."},
    {"class/start", "Makes the folder with a key for each station, starts broker and collector, opens the teacher's window."},
    {"class/end", "Stations keep what they have and send it next time."},
    {"class/watched", "Folder of the class, or instructor folder that you were given."},
    {"class/watch", "Every station live: who needs help comes first."},
    {"class/station", "The folder that you were given: stations/s01 of the class."},
    {"class/join", "The training of this station; its results go to the class."},
};
// clang-format on

}  // namespace

std::string_view controlWords(std::string_view path) {
  const auto row = std::find_if(std::begin(kControlWords), std::end(kControlWords), [&](const ControlRow& r) {
    return r.path.ends_with('/') ? path.starts_with(r.path) : path == r.path;
  });
  return row == std::end(kControlWords) ? std::string_view() : row->words;
}

}  // namespace palpate::viewer
