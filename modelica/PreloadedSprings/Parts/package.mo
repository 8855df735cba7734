within PreloadedSprings;
package Parts "Bodies that the springs act on"
  extends PreloadedSprings.Icons.Package;
end Parts;
