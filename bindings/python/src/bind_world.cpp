// World: made of a scene, of text, of a built-in body, of a mesh file or of arrays.
#include "bindings.h"
#include "interrupts.h"
#include "palpate/scene/scene_file.h"
#include "world_handle.h"

namespace palpate::python {

void bindWorld(py::module_& module) {
  py::class_<WorldHandle, WorldPointer>(module, "World", "A body that can be felt.")
      .def_static(
          "parse",
          [](const std::string& toml, const std::string& name) {
            Interrupts interrupts;
            const py::gil_scoped_release free;
            return std::make_shared<WorldHandle>(
                WorldHandle{scene::build(scene::parse(toml, name), interrupts.progress())});
          },
          py::arg("toml"), py::arg("name") = "scene", "A world from the text of a scene file.");
}

}  // namespace palpate::python
