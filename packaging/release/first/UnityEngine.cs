// What FirstTouch.cs asks of Unity, and an engine that plays it until it reports: tools/release --check compiles both by Mono.
using System;
using System.Reflection;

namespace UnityEngine
{
    public struct Touch { } // Unity has one, too: the sample must say which it means
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 one { get { return new Vector3(1, 1, 1); } }
        public static Vector3 operator *(Vector3 a, float k) { return new Vector3(a.x * k, a.y * k, a.z * k); }
    }
    public class RequireComponent : Attribute { public RequireComponent(Type one, Type two) { } }
    public enum PrimitiveType { Sphere }
    public class Material { }
    public class MeshFilter { public Mesh mesh; }
    public class MeshRenderer { public Material sharedMaterial = new Material(); }
    public class Transform
    {
        public Vector3 position, localScale;
        public Vector3 TransformPoint(Vector3 point) { return point; }
    }
    public class Mesh
    {
        public Rendering.IndexFormat indexFormat;
        public int[] triangles;
        public Vector3[] vertices, normals;
        public void MarkDynamic() { }
        public void RecalculateBounds() { }
        public void SetVertices(Vector3[] points) { vertices = points; }
        public void SetNormals(Vector3[] directions) { normals = directions; }
    }
    public class GameObject
    {
        public Transform transform = new Transform();
        public T GetComponent<T>() where T : new() { return new T(); }
        public static GameObject CreatePrimitive(PrimitiveType type) { return new GameObject(); }
    }
    public class MonoBehaviour
    {
        public Transform transform = new Transform();
        public MeshFilter filter = new MeshFilter();
        public T GetComponent<T>() where T : class, new() { return filter as T ?? new T(); }
    }
    public static class Debug
    {
        public static string Last;
        public static void Log(object words) { Last = words.ToString(); }
    }
    namespace Rendering { public enum IndexFormat { UInt32 } }
}

public static class Program
{
    static void Call(object behaviour, string method)
    {
        behaviour.GetType().GetMethod(method, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(behaviour, null);
    }

    public static int Main()
    {
        var touch = new FirstTouch();
        Call(touch, "Awake");
        var rest = (UnityEngine.Vector3[])touch.filter.mesh.vertices.Clone();
        for (int frame = 0; frame < 1000 && UnityEngine.Debug.Last == null; ++frame)
        {
            Call(touch, "Update");
            System.Threading.Thread.Sleep(16);
        }
        float deepest = 0; // into the body: Unity's z
        for (int i = 0; i < rest.Length; ++i) deepest = Math.Max(deepest, touch.filter.mesh.vertices[i].z - rest[i].z);
        Call(touch, "OnDestroy");
        Console.WriteLine("the skin is {0:F4} m in", deepest);
        Console.WriteLine(UnityEngine.Debug.Last);
        return deepest > 0.002f ? 0 : 1;
    }
}
