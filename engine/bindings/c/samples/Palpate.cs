// Palpate for C#: .NET, Mono, Unity. One file to copy; it needs libpalpate.so beside the program, or in Assets/Plugins of
// a Unity project, and "allow unsafe code".
//
// Units and axes are those of palpate.h: mm, N, s; x right, y towards the head, z out of the back, right-handed. Unity's
// are metres and left-handed: see InUnity.
//
// Threads: a World may be used by any number of threads; a Finger, a Skin and a Session by one at a time. Step neither
// allocates nor locks, so it may stand in a loop of 1,000 Hz on a thread of its own.
//
// Fixed buffers stand one to a line: Mono's compiler lays out `fixed double a[3], b[3];` wrongly.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Palpate
{
    /// What the library refuses; Line counts from 1, 0 is unknown.
    public sealed class PalpateException : Exception
    {
        public readonly int Code;
        public readonly int Line;
        public PalpateException(int code, int line, string message) : base(message) { Code = code; Line = line; }
    }

    public enum Contact { Free = 0, Stick = 1, Slip = 2 }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct FingerSettings
    {
        internal UIntPtr size;
        public double RadiusMm;
        public double StiffnessRatio;
        public double MuStatic;
        public double MuDynamic;
        public double MaxDepthMm;
        public double TickS;
        public double CatchUpMmPerS;
        public int ForceShading;
        internal int reserved;
        public double RelaxationShare;
        public double RelaxationTimeS;
        public double RelaxationShare2;
        public double RelaxationTime2S;

        public static FingerSettings Default()
        {
            FingerSettings settings;
            Native.palpate_finger_settings_init(&settings, (UIntPtr)sizeof(FingerSettings));
            return settings;
        }
    }

    /// What a finger felt in one tick (palpate_touch).
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Touch
    {
        internal UIntPtr size;
        public fixed double ForceN[3];
        public double DepthMm;
        public Contact Contact;
        public uint Status;
        public fixed double Normal[3];
        public fixed double TipMm[3];
        public fixed double ProxyMm[3];
        public fixed double AnchorMm[3];
        public fixed double HoldMm[3];
        public uint Triangle;
        public uint AnchorTriangle;
        public double TissueMm;
        public double RestMm;
        public fixed double DentMm[3];
        public double DentRestMm;
        public uint DentTriangle;
        internal uint reserved;
        public ulong Tick;
        public fixed double LumpForceN[3];
        public double LumpShare;
        public fixed double LumpMovedMm[2];
        public uint Lump;
        internal uint reserved2;

        public static Touch New()
        {
            var touch = new Touch();
            touch.size = (UIntPtr)sizeof(Touch);
            touch.Triangle = touch.AnchorTriangle = touch.DentTriangle = touch.Lump = 0xffffffff;
            return touch;
        }
    }

    /// A named place of the skin at rest (palpate_place).
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Place
    {
        internal UIntPtr size;
        public fixed double PointMm[3];
        public fixed double Normal[3];
        public uint Triangle;
        internal uint reserved;
        internal fixed byte name[128];
        public string Name { get { fixed (byte* text = name) return Native.TextAt(text, 128); } }
    }

    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct WorldFacts
    {
        internal UIntPtr size;
        public ulong Vertices;
        public ulong Triangles;
        public ulong Landmarks;
        public ulong Notes;
        public ulong Fingers;
        public fixed double LowMm[3];
        public fixed double HighMm[3];
        public int Closed;
        public int Breathes;
        public double TicksPerS;
        public ulong Hash;
        internal fixed byte bodyName[128];
        public string BodyName { get { fixed (byte* text = bodyName) return Native.TextAt(text, 128); } }
        public ulong Lumps;
    }

    /// A lump under the skin, as it lies in a body (palpate_lump).
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct Lump
    {
        internal UIntPtr size;
        public fixed double FootMm[3];
        public fixed double Axis[3];
        public fixed double Across[3];
        public fixed double Up[3];
        public fixed double HalfAxesMm[3];
        public double DepthMm;
        public double YoungKpa;
        public double LayerKpa;
        public double TissueMm;
        public double MobilityMmPerN;
        public double MobilityLimitMm;
        public fixed double Share[3];
        internal fixed byte name[64];
        public string Name { get { fixed (byte* text = name) return Native.TextAt(text, 64); } }
    }

    /// A body that can be felt; immutable.
    public sealed unsafe class World : IDisposable
    {
        internal IntPtr Handle;
        World(IntPtr handle) { Handle = handle; }

        public static World Load(string file)
        {
            Native.Check();
            IntPtr world;
            var error = Native.Error.New();
            fixed (byte* path = Native.Bytes(file)) error.Throw(Native.palpate_world_load(path, out world, &error));
            return new World(world);
        }
        /// A scene's text; "" is the built-in trunk.
        public static World Parse(string toml, string name = "scene")
        {
            Native.Check();
            IntPtr world;
            var error = Native.Error.New();
            fixed (byte* text = Native.Bytes(toml), file = Native.Bytes(name))
                error.Throw(Native.palpate_world_parse(text, file, out world, &error));
            return new World(world);
        }
        public static World Torso(int triangles = 0)
        {
            Native.Check();
            IntPtr world;
            var error = Native.Error.New();
            error.Throw(Native.palpate_world_torso((UIntPtr)(uint)triangles, out world, &error));
            return new World(world);
        }
        /// xyz: three numbers a vertex, mm; corners: three a triangle, counter-clockwise seen from outside. stiffness: one
        /// a vertex, N/mm, or null.
        public static World FromArrays(float[] xyz, int[] corners, double[] stiffness = null, string sceneToml = null)
        {
            Native.Check();
            if (xyz.Length % 3 != 0 || corners.Length % 3 != 0) throw new ArgumentException("three numbers each");
            if (stiffness != null && stiffness.Length != xyz.Length / 3) throw new ArgumentException("one a vertex");
            IntPtr world;
            var error = Native.Error.New();
            fixed (float* positions = xyz)
            fixed (int* indices = corners)
            fixed (double* values = stiffness)
            fixed (byte* scene = sceneToml == null ? null : Native.Bytes(sceneToml))
            {
                var arrays = new Native.Arrays();
                arrays.size = (UIntPtr)sizeof(Native.Arrays);
                arrays.positionsF32 = positions;
                arrays.vertices = (UIntPtr)(uint)(xyz.Length / 3);
                arrays.corners = indices;
                arrays.triangles = (UIntPtr)(uint)(corners.Length / 3);
                arrays.stiffness = values;
                arrays.scene = scene;
                error.Throw(Native.palpate_world_from_arrays(&arrays, out world, &error));
            }
            return new World(world);
        }
        public WorldFacts Facts()
        {
            WorldFacts facts = new WorldFacts();
            facts.size = (UIntPtr)sizeof(WorldFacts);
            Native.Throw(Native.palpate_world_get_facts(Handle, &facts), "the world was disposed of");
            GC.KeepAlive(this);
            return facts;
        }
        /// "T6", "left PSIS", "T6 right 30 mm".
        public Place Place(string words)
        {
            var place = new Place();
            place.size = (UIntPtr)sizeof(Place);
            var error = Native.Error.New();
            fixed (byte* text = Native.Bytes(words))
                error.Throw(Native.palpate_world_place(Handle, text, &place, &error));
            GC.KeepAlive(this);
            return place;
        }
        /// Lump number `index`, from 0; WorldFacts.Lumps says how many there are.
        public Lump Lump(int index)
        {
            var lump = new Lump();
            lump.size = (UIntPtr)sizeof(Lump);
            Native.Throw(Native.palpate_world_lump(Handle, (UIntPtr)(uint)index, &lump), "there is no such lump");
            GC.KeepAlive(this);
            return lump;
        }
        /// Three vertices of each triangle of the skin.
        public int[] Triangles()
        {
            var corners = new int[3 * (int)Facts().Triangles];
            Marshal.Copy(Native.palpate_world_triangles(Handle), corners, 0, corners.Length);
            GC.KeepAlive(this);
            return corners;
        }
        public void Dispose()
        {
            Native.palpate_world_release(Handle);
            Handle = IntPtr.Zero;
            GC.SuppressFinalize(this);
        }
        ~World() { Native.palpate_world_release(Handle); }
    }

    public sealed unsafe class Finger : IDisposable
    {
        IntPtr handle;
        /// Of the scene's first finger.
        public Finger(World world) { Make(world, null); }
        public Finger(World world, FingerSettings settings) { Make(world, &settings); }
        void Make(World world, FingerSettings* settings)
        {
            var error = Native.Error.New();
            error.Throw(Native.palpate_finger_create(world.Handle, settings, out handle, &error));
            GC.KeepAlive(world);
        }
        /// One tick, the tip at x, y, z (mm). `touch` comes from Touch.New(). Allocates nothing.
        public void Step(double x, double y, double z, ref Touch touch)
        {
            double* tip = stackalloc double[3];
            tip[0] = x;
            tip[1] = y;
            tip[2] = z;
            fixed (Touch* felt = &touch)
                if (Native.palpate_finger_step(handle, tip, felt) != 0) Native.Throw(1, "the finger was disposed of, or the touch is not New()");
            GC.KeepAlive(this);
        }
        /// Pressure on the fingertip in its last step, kPa: `taxels` rows of as many, the first nearest to the head.
        public float[] Pressure(int taxels = 4, double padMm = 16)
        {
            if (taxels < 2 || taxels > 16) throw new ArgumentException("2 to 16 taxels");
            var kpa = new float[taxels * taxels];
            fixed (float* to = kpa)
                Native.Throw(Native.palpate_finger_pressure(handle, (UIntPtr)(uint)taxels, padMm, to, null), "the finger was disposed of, or the tissue has no layers");
            GC.KeepAlive(this);
            return kpa;
        }
        public void Lift() { Native.palpate_finger_lift(handle); GC.KeepAlive(this); }
        public void Dispose()
        {
            Native.palpate_finger_release(handle);
            handle = IntPtr.Zero;
            GC.SuppressFinalize(this);
        }
        ~Finger() { Native.palpate_finger_release(handle); }
    }

    /// The skin as fingers leave it.
    public sealed unsafe class Skin : IDisposable
    {
        IntPtr handle;
        public readonly int Vertices;
        public Skin(World world, int fingers = 1, bool strain = false)
        {
            var error = Native.Error.New();
            error.Throw(Native.palpate_skin_create(world.Handle, (UIntPtr)(uint)fingers, strain ? 1 : 0, out handle, &error));
            GC.KeepAlive(world);
            Vertices = (int)Native.palpate_skin_vertices(handle);
        }
        public void Apply(params Touch[] touches)
        {
            fixed (Touch* first = touches)
                Native.Throw(Native.palpate_skin_apply(handle, first, (UIntPtr)(uint)touches.Length, (UIntPtr)sizeof(Touch)),
                             "touches that are not of this skin, or more than it has room for");
            GC.KeepAlive(this);
        }
        /// x, y, z of each vertex, one after the other; null: the caller has no room yet.
        public float[] Positions(float[] into = null) { return Interleaved(Native.palpate_skin_positions, into); }
        public float[] Normals(float[] into = null) { return Interleaved(Native.palpate_skin_normals, into); }

        delegate float* Axis(IntPtr skin, int axis);
        float[] Interleaved(Axis of, float[] into)
        {
            if (into == null) into = new float[3 * Vertices];
            if (into.Length != 3 * Vertices) throw new ArgumentException("three numbers a vertex");
            for (int axis = 0; axis < 3; ++axis)
            {
                float* from = of(handle, axis);
                if (from == null) throw new ObjectDisposedException("Skin");
                for (int v = 0; v < Vertices; ++v) into[3 * v + axis] = from[v];
            }
            GC.KeepAlive(this);
            return into;
        }
        public void Dispose()
        {
            Native.palpate_skin_release(handle);
            handle = IntPtr.Zero;
            GC.SuppressFinalize(this);
        }
        ~Skin() { Native.palpate_skin_release(handle); }
    }

    /// Between the body's frame (mm, right-handed, z out of the back) and Unity's (m, left-handed): z is turned round,
    /// and with it the corners of every triangle.
    public static class InUnity
    {
        public const float MetresPerMm = 0.001f;
        public static void FromBody(float[] xyzMm)
        {
            for (int i = 0; i < xyzMm.Length; i += 3)
            {
                xyzMm[i] *= MetresPerMm;
                xyzMm[i + 1] *= MetresPerMm;
                xyzMm[i + 2] *= -MetresPerMm;
            }
        }
        public static void TurnTriangles(int[] corners)
        {
            for (int i = 0; i + 2 < corners.Length; i += 3)
            {
                int second = corners[i + 1];
                corners[i + 1] = corners[i + 2];
                corners[i + 2] = second;
            }
        }
    }

    /// The functions of palpate.h as they are.
    public static unsafe class Native
    {
        const string Library = "palpate";

        [StructLayout(LayoutKind.Sequential)]
        public struct Error
        {
            internal UIntPtr size;
            internal int code;
            internal int line;
            internal fixed byte message[512];
            internal static Error New()
            {
                var error = new Error();
                error.size = (UIntPtr)sizeof(Error);
                return error;
            }
            internal void Throw(int answer)
            {
                if (answer == 0) return;
                fixed (byte* text = message) throw new PalpateException(answer, line, TextAt(text, 512));
            }
        }

        [StructLayout(LayoutKind.Sequential)]
        public struct Arrays
        {
            internal UIntPtr size;
            internal double* positions;
            internal float* positionsF32;
            internal UIntPtr vertices;
            internal int* corners;
            internal long* cornersI64;
            internal UIntPtr triangles;
            internal double* stiffness;
            internal byte* scene;
        }

        static bool isChecked;
        /// Once: the structures here are as long as those of the header that this file was written for.
        internal static void Check()
        {
            if (isChecked) return;
            if (sizeof(Touch) != 296 || sizeof(FingerSettings) != 104 || sizeof(Place) != 192 || sizeof(WorldFacts) != 256 || sizeof(Lump) != 264 ||
                sizeof(Error) != 528 || sizeof(Arrays) != 72)
                throw new PalpateException(4, 0, "this compiler lays out Palpate.cs otherwise than C");
            isChecked = true;
        }
        internal static void Throw(int answer, string why)
        {
            if (answer != 0) throw new PalpateException(answer, 0, why);
        }
        internal static byte[] Bytes(string text) { return Encoding.UTF8.GetBytes(text + "\0"); }
        internal static string TextAt(byte* text, int room)
        {
            int length = 0;
            while (length < room && text[length] != 0) ++length;
            return Encoding.UTF8.GetString(text, length);
        }
        public static string Version() { return Marshal.PtrToStringAnsi(palpate_version()); }

        [DllImport(Library)] public static extern IntPtr palpate_version();
        [DllImport(Library)] public static extern int palpate_world_load(byte* path, out IntPtr world, Error* error);
        [DllImport(Library)] public static extern int palpate_world_parse(byte* toml, byte* name, out IntPtr world, Error* error);
        [DllImport(Library)] public static extern int palpate_world_torso(UIntPtr triangles, out IntPtr world, Error* error);
        [DllImport(Library)] public static extern int palpate_world_from_arrays(Arrays* arrays, out IntPtr world, Error* error);
        [DllImport(Library)] public static extern void palpate_world_release(IntPtr world);
        [DllImport(Library)] public static extern int palpate_world_get_facts(IntPtr world, WorldFacts* facts);
        [DllImport(Library)] public static extern int palpate_world_place(IntPtr world, byte* words, Place* place, Error* error);
        [DllImport(Library)] public static extern int palpate_world_lump(IntPtr world, UIntPtr index, Lump* lump);
        [DllImport(Library)] public static extern IntPtr palpate_world_triangles(IntPtr world);
        [DllImport(Library)] public static extern void palpate_finger_settings_init(FingerSettings* settings, UIntPtr size);
        [DllImport(Library)] public static extern int palpate_finger_create(IntPtr world, FingerSettings* settings, out IntPtr finger, Error* error);
        [DllImport(Library)] public static extern int palpate_finger_step(IntPtr finger, double* tip, Touch* touch);
        [DllImport(Library)] public static extern int palpate_finger_pressure(IntPtr finger, UIntPtr taxels, double padMm, float* kpa, float* shear);
        [DllImport(Library)] public static extern int palpate_finger_lift(IntPtr finger);
        [DllImport(Library)] public static extern void palpate_finger_release(IntPtr finger);
        [DllImport(Library)] public static extern int palpate_skin_create(IntPtr world, UIntPtr fingers, int strain, out IntPtr skin, Error* error);
        [DllImport(Library)] public static extern int palpate_skin_apply(IntPtr skin, Touch* touches, UIntPtr count, UIntPtr stride);
        [DllImport(Library)] public static extern UIntPtr palpate_skin_vertices(IntPtr skin);
        [DllImport(Library)] public static extern float* palpate_skin_positions(IntPtr skin, int axis);
        [DllImport(Library)] public static extern float* palpate_skin_normals(IntPtr skin, int axis);
        [DllImport(Library)] public static extern void palpate_skin_release(IntPtr skin);
    }
}
