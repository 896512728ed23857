// Text formats as programs write them, not as their descriptions have them: one way to open a file, one rule for what a
// row is, and faults that take nothing from the surface are told and decide about nothing.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/validate.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::mesh {

namespace {

using Notes = std::vector<std::string>;

// One tetrahedron of volume 1/6 in every format.
const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string kOff = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n";
const std::string kPly = kPlyHead + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kStl =
    "solid s\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid s\n";

struct TextFile {
  const char* extension;
  Format format;
  std::string text;
};
const std::vector<TextFile> kFiles = {
    {"obj", Format::obj, kObj}, {"off", Format::off, kOff}, {"ply", Format::ply, kPly}, {"stl", Format::stl, kStl}};

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string inCapitals(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

/// Reads the text as a file of that format and expects the tetrahedron; what was told.
Notes notesOf(const std::string& text, Format format) {
  const MeshWithChannels loaded = loadWithChannelsFromMemory(text, format, "x");
  const ValidationReport report = validate(loaded.mesh);
  EXPECT_TRUE(report.closed) << text;
  EXPECT_NEAR(report.volume_mm3, 1.0 / 6.0, 1e-12) << text;
  return loaded.notes;
}

std::string loadError(const std::string& text, Format format) {
  return support::thrownMessage([&] { loadWithChannelsFromMemory(text, format, "x"); });
}

// --- one way to open a file ---

TEST(TextFiles, AreReadWithAnyLineEndsCapitalsAndAByteOrderMark) {
  const support::TemporaryFolder folder;
  for (const auto& [extension, format, text] : kFiles) {
    const std::string mark = "\xef\xbb\xbf";
    for (const std::string& written :
         {text, mark + text, replaced(text, "\n", "\r\n"), mark + replaced(text, "\n", "\r"), inCapitals(text),
          replaced(text, " ", "\t"), replaced(text, "\n", " \t\n"), text.substr(0, text.size() - 1)}) {
      EXPECT_EQ(notesOf(written, format), Notes()) << written;
      // What decides the format is not stricter than its reader.
      const auto file = folder / (std::string("body.") + extension);
      writeFile(file, written);
      EXPECT_EQ(load(file).triangles.size(), 4u) << written;
      if (format == Format::obj || format == Format::stl) continue;  // known by their extension alone
      writeFile(folder / "body.obj", written);
      EXPECT_EQ(load(folder / "body.obj").triangles.size(), 4u) << written;
    }
  }
}

TEST(TextFiles, InUtf16AreRefusedByThatReason) {
  for (const auto& [extension, format, text] : kFiles) {
    if (format == Format::stl) continue;  // any two bytes may begin a binary one
    EXPECT_EQ(loadError("\xff\xfe" + text, format), "x:1: the text is UTF-16; save it as UTF-8");
  }
}

TEST(TextFiles, OfWindowsOlderLibraryHaveItsNumbersThatAreNone) {
  EXPECT_EQ(notesOf(replaced(kStl, "normal 0 0 -1", "normal -1.#IND 1.#QNAN -nan(ind)"), Format::stl), Notes());
  EXPECT_EQ(
      validate(loadFromMemory(replaced(kObj, "v 0 0 1", "v 0 0 -1.#IND"), Format::obj, "x")).non_finite_vertices.count,
      1u);
}

// --- a row is a line ---

TEST(PlyRows, NeverTakeAValueOfAnotherLine) {
  const std::string told = "the row has more values than the header declares; they are skipped";
  EXPECT_EQ(notesOf(replaced(kPly, "3 1 2 3\n", "3 1 2 3 0 0\n"), Format::ply), Notes{"x:16: " + told});
  EXPECT_EQ(
      notesOf(
          kPlyHead + "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n0 0 1 255 0 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n",
          Format::ply),
      Notes{"x:10: " + told + " (4 times)"});
  EXPECT_EQ(notesOf(kPly + "0 1\n\n1 2\n", Format::ply),
            Notes{"x:18: a line after the last row declared by the header is skipped (2 times)"});
  EXPECT_EQ(notesOf(replaced(kPly, "1 0 0\n", "\n1 0 0\n\n"), Format::ply), Notes()) << "blank lines are no rows";
  EXPECT_EQ(loadError(replaced(kPly, "1 0 0\n", "1 0\n"), Format::ply),
            "x:11: the row has fewer values than the header names");
  EXPECT_EQ(loadError(replaced(kPly, "3 1 2 3\n", "3 1 2\n3\n"), Format::ply),
            "x:16: the row has fewer values than the header names");
  EXPECT_EQ(loadError(kPly.substr(0, kPly.size() - 8), Format::ply),
            "x:16: the file ends before all its elements are there");
}

TEST(PlyRows, OfElementsThatNobodyNeedsMayBeAnything) {
  const std::string head = replaced(kPlyHead, "element face", "element note 2\nproperty float a\nelement face");
  EXPECT_EQ(notesOf(head + "0 0 0\n1 0 0\n0 1 0\n0 0 1\nn/a\n- - -\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n", Format::ply),
            Notes{"x: left out: elements 'note' (2)"});
}

TEST(PlyRows, InBinaryMayHaveBytesBehindThem) {
  std::string ply = replaced(replaced(kPlyHead, "ascii", "binary_little_endian"), "element face 4", "element face 1");
  ply = replaced(ply, "list uchar int", "list uchar uchar");
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) {
    ply.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  ply += std::string("\3\0\2\1", 4);
  const auto whole = loadWithChannelsFromMemory(ply, Format::ply, "x");
  EXPECT_EQ(whole.mesh.triangles.size(), 1u);
  EXPECT_EQ(whole.notes, Notes());
  const auto longer = loadWithChannelsFromMemory(ply + "tail", Format::ply, "x");
  EXPECT_EQ(longer.mesh.triangles.size(), 1u);
  EXPECT_EQ(longer.notes, Notes{"x: byte " + std::to_string(ply.size()) +
                                ": bytes after the last row declared by the header are skipped"});
}

TEST(PlyRows, MayBeginWithAByteThatIsALineEndElsewhere) {
  // Lines that end in CR alone, and a first byte of 10: the number 10 of one byte.
  std::string ply =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\rproperty uchar y\rproperty uchar z\r"
      "element face 1\rproperty list uchar uchar vertex_indices\rend_header\r";
  ply += std::string("\12\0\0\0\12\0\0\0\12\3\0\1\2", 13);
  EXPECT_EQ(loadFromMemory(ply, Format::ply, "x").positions[0], Vec3(10, 0, 0));
}

TEST(PlyHeads, AreReadAsProgramsWriteThem) {
  EXPECT_EQ(notesOf(replaced(kPly, "property list uchar int vertex_indices", "property list uint8 int32 vertex_index"),
                    Format::ply),
            Notes());
  EXPECT_EQ(notesOf(replaced(kPly, "ply\n", "\nply \ncomment made by hand\nobj_info num_cols 4\n"), Format::ply),
            Notes());
  EXPECT_EQ(notesOf(replaced(kPly, "end_header", "viewpoint 0 0 0\nend_header"), Format::ply),
            Notes{"x:9: 'viewpoint' is not a keyword of a PLY header; the line is skipped"});
  EXPECT_EQ(notesOf(replaced(kPly, "property float x", "property half x"), Format::ply), Notes());
  EXPECT_EQ(loadError(replaced(kPly, "vertex_indices", "corners"), Format::ply),
            "x:13: 'face' has no list 'vertex_indices'");
}

TEST(PlyHeads, MayHaveStripsOfTriangles) {
  const std::string strips =
      replaced(replaced(kPlyHead, "element face 4", "element tristrips 1"), "uchar int", "int int");
  EXPECT_EQ(notesOf(strips + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 0 2 1 3 -1 1 3 0 2\n", Format::ply), Notes());
}

TEST(OffRows, MayHaveCommentsColoursAndWhatNobodyNeeds) {
  EXPECT_EQ(notesOf(replaced(kOff, "1 0 0\n", "# a vertex\n1 0 0 # here\n\n"), Format::off), Notes());
  EXPECT_EQ(notesOf(replaced(kOff, "3 1 2 3\n", "3 1 2 3 0.1 0.2 0.3 1\n"), Format::off), Notes());
  EXPECT_EQ(notesOf(replaced(replaced(kOff, "1 0 0\n", "1 0 0 255 0 0 255\n"), "OFF", "COFF"), Format::off), Notes());
  EXPECT_EQ(notesOf(replaced(kOff, "1 0 0\n", "1 0 0 255 0 0\n"), Format::off),
            Notes{"x:4: values after a vertex's coordinates are skipped"});
  EXPECT_EQ(notesOf(kOff + "3 0 1 2\n", Format::off), Notes{"x:11: a line after the last face is skipped"});
  EXPECT_EQ(loadError(replaced(kOff, "1 0 0\n", "1 0\n0\n"), Format::off), "x:4: a coordinate is missing");
}

TEST(OffHeads, AreReadAsProgramsWriteThem) {
  for (const char* head : {"OFF4 4 6\n", "OFF 4 4 6\n", "off\n4 4\n", "Off # of a cube\n\n# counts\n4 4 6\n", "4 4 6\n",
                           "# first\nOFF\n4\n4\n", "NOFF\n4 4 0\n", "STCNOFF\n4 4 0\n", "nOFF 3\n4 4 0\n"}) {
    EXPECT_EQ(notesOf(head + kOff.substr(kOff.find("0 0 0")), Format::off), Notes()) << head;
  }
  EXPECT_EQ(loadError(replaced(kOff, "OFF", "4OFF"), Format::off),
            "x:1: OFF with a fourth coordinate (4OFF) cannot be read");
  EXPECT_EQ(loadError(replaced(kOff, "OFF\n", "nOFF 4\n"), Format::off),
            "x:1: only OFF in 3 dimensions can be read, not in '4'");
  EXPECT_EQ(loadError(replaced(kOff, "OFF\n", "OFF BINARY\n"), Format::off), "x:1: binary OFF cannot be read");
  EXPECT_EQ(loadError(replaced(kOff, "OFF\n", "OFFICE\n"), Format::off), "x:1: 'OFF' is expected, not 'OFFICE'");
}

TEST(ObjRows, GoOnBehindABackslashGluedOrNot) {
  EXPECT_EQ(notesOf(replaced(kObj, "v 0 0 1", "v 0 0\\\n1"), Format::obj), Notes());
  EXPECT_EQ(notesOf(replaced(kObj, "f 2 3 4", "f 2\\\r\n3 \\ \n \\\n4"), Format::obj), Notes());
  EXPECT_EQ(notesOf("# C:\\scans\\\n" + kObj, Format::obj), Notes()) << "a comment ends with its line";
  EXPECT_EQ(notesOf("mtllib a.mtl \\\n b.mtl\n" + kObj, Format::obj), Notes());
  EXPECT_EQ(loadError("v 0 0 0\nv 0 0\\\n\\\n0 0\nf 1 2\\\n 9\n", Format::obj),
            "x:5: the face uses vertex 9, but there are 2 vertices");
}

TEST(ObjRows, MayHaveWeightsColoursCommentsAndWhatNobodyNeeds) {
  EXPECT_EQ(notesOf(replaced(kObj, "v 1 0 0", "v 1 0 0 1.0 # here"), Format::obj), Notes());
  EXPECT_EQ(notesOf(replaced(kObj, "v 1 0 0", "v 1 0 0 0.5 0.5 1e-3"), Format::obj), Notes());
  EXPECT_EQ(notesOf(replaced(kObj, "f 2 3 4", "f 2//1 3/ 4/7/1 # there"), Format::obj), Notes());
  EXPECT_EQ(notesOf(replaced(kObj, "v 1 0 0", "v 1 0 0 red"), Format::obj),
            Notes{"x:2: values after a vertex's coordinates are skipped"});
  EXPECT_EQ(notesOf("vt ? 1.#QNAN\nvn\n" + replaced(kObj, "f 1", "fo 1"), Format::obj), Notes());
  EXPECT_EQ(notesOf("Xdata 1 2\n" + kObj + "surf 0 1 0 1 1 2\n", Format::obj),
            (Notes{"x:1: 'Xdata' is not an OBJ keyword; the line is skipped",
                   "x:10: 'surf' defines a surface, which is not supported; only faces are read"}));
}

TEST(ObjGroups, OfFacesAndObjectsAreTwoThings) {
  const std::string faces = kObj.substr(0, kObj.find('f'));
  const auto triangles_of = [&](const std::string& rest, const std::string& group) {
    return loadFromMemory(faces + rest, Format::obj, "x", {.group = group}).triangles.size();
  };
  const std::string in_object = "o body\ng skin\nf 1 3 2\nf 1 2 4\ng nail\nf 2 3 4\no other\nf 3 1 4\n";
  EXPECT_EQ(triangles_of(in_object, "body"), 3u) << "an object goes on through its groups";
  EXPECT_EQ(triangles_of(in_object, "skin"), 2u);
  EXPECT_EQ(triangles_of(in_object, "nail"), 2u) << "a group goes on through objects";
  const std::string in_group = "g body\no body_mesh\nf 1 3 2\no rest\nf 1 2 4\ng other\nf 2 3 4\n";
  EXPECT_EQ(triangles_of(in_group, "body"), 2u);
  EXPECT_EQ(triangles_of(in_group, "body_mesh"), 1u);
  EXPECT_EQ(triangles_of("o My body #1\nf 1 3 2\no b\nf 1 2 4\n", "My body #1"), 1u) << "a name with blanks";
  EXPECT_EQ(support::thrownMessage([&] { triangles_of("g none\ng all\nf 1 3 2\n", "none"); }),
            "x: the group or object 'none' has no faces");
}

// --- text or binary STL ---

/// With its triangles as the format has them: 84 bytes and 50 a triangle.
std::string binaryStl(std::string header, std::uint32_t triangles) {
  header.resize(80, ' ');
  for (int shift = 0; shift < 32; shift += 8) header += static_cast<char>((triangles >> shift) & 0xff);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const float values[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(t)};
    header.append(reinterpret_cast<const char*>(values), sizeof(values)).append(2, '\0');
  }
  return header;
}

TEST(StlFiles, AreTextOrBinaryByWhatTheyHoldNotByTheirLength) {
  for (const char* header : {"made by hand", "solid made by hand", "SOLID", "\xef\xbb\xbfsolid"}) {
    const std::string stl = binaryStl(header, 7);
    EXPECT_EQ(loadWithChannelsFromMemory(stl, Format::stl, "x").notes, Notes()) << header;
    const auto longer = loadWithChannelsFromMemory(stl + std::string(92, 't'), Format::stl, "x");
    EXPECT_EQ(longer.mesh.triangles.size(), 7u) << header;
    EXPECT_EQ(longer.notes, Notes{"x: byte 434: 92 bytes after the 7 triangles are skipped"}) << header;
    EXPECT_EQ(loadError(stl.substr(0, 400), Format::stl),
              "x: byte 80: not an STL file, or damaged: 7 triangles need 434 bytes, the file has 400")
        << header;
  }
}

TEST(StlFiles, OfTextMayHaveWhatNobodyNeeds) {
  EXPECT_EQ(notesOf(replaced(kStl, "normal 0 0 -1", ""), Format::stl), Notes());
  EXPECT_EQ(notesOf(kStl.substr(kStl.find("facet")), Format::stl), Notes()) << "without its first line";
  EXPECT_EQ(notesOf(replaced(kStl, "solid s\nfacet", "solid s\ncolor 1 0 0\nfacet"), Format::stl),
            Notes{"x:2: 'color' is not an STL keyword; the line is skipped"});
  EXPECT_EQ(notesOf(replaced(kStl, "endsolid s\n", "endsolid s\n\nwritten by hand\n"), Format::stl),
            Notes{"x:32: 'written' is not an STL keyword; the line is skipped"});
}

// --- one rule for faces of too few corners ---

TEST(TextFiles, TellFacesOfTwoCornersAndReadTheRest) {
  const std::string told = "a face with fewer than 3 corners is skipped";
  EXPECT_EQ(notesOf(kObj + "f 1 2\nf 1\nf 1 99\n", Format::obj), Notes{"x:9: " + told + " (3 times)"});
  EXPECT_EQ(notesOf(replaced(replaced(kOff, "4 4 6", "4 5 6"), "3 1 2 3\n", "2 1 2\n3 1 2 3\n"), Format::off),
            Notes{"x:9: " + told});
  EXPECT_EQ(notesOf(replaced(replaced(kPly, "face 4", "face 5"), "3 1 2 3\n", "2 1 2\n3 1 2 3\n"), Format::ply),
            Notes{"x:16: " + told});
  EXPECT_EQ(notesOf(replaced(kStl, "endsolid",
                             "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid"),
                    Format::stl),
            Notes{"x:30: " + told});
}

TEST(StlFiles, OfTextMayHaveLoopsOfFourCorners) {
  const auto mesh = loadFromMemory(
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 2 2 0\nvertex 0 2 0\nendloop\n"
      "endfacet\nendsolid\n",
      Format::stl, "x");
  EXPECT_NEAR(validate(mesh).area_mm2, 4.0, 1e-12);
}

}  // namespace

}  // namespace palpate::mesh
