within PreloadedSprings;
package Springs "Restrained preloaded springs and what is built from them"
  extends PreloadedSprings.Icons.Package;
end Springs;
