within PreloadedSprings;
package Interfaces "Connectors and partial components"
  extends PreloadedSprings.Icons.Package;
end Interfaces;
