<?xml version="1.0" encoding="UTF-8"?>
<!--
  Job file for ColorNet: the aspecular Lab values to match, and the code of the paint
  from which the reformulation starts.

  The import format of ColorNet is not published. This is paintlink's own document,
  described by colornet.xsd; it holds what ColorNet is known to need. A site whose
  formulation software wants other names or another order copies this one file into its
  folder of formats and changes the template below. docs/formats.md shows how.
-->
<xsl:stylesheet version="1.0"
                xmlns:xsl="http://www.w3.org/1999/XSL/Transform"
                xmlns:spec="urn:paintlink:color-specification:1"
                xmlns:past="urn:paintlink:formulation-history:1"
                xmlns="urn:paintlink:colornet-job:1"
                exclude-result-prefixes="spec past">

  <format xmlns="urn:paintlink:export-format:1"
          id="colornet"
          label="ColorNet job (XML)"
          suffix="xml"
          file-name="{date}_{name}_{paint}"
          starting-paint="required"/>

  <xsl:output method="xml" encoding="UTF-8" indent="yes"/>

  <xsl:param name="job-id"/>
  <xsl:param name="created-at"/>
  <xsl:param name="origin"/>
  <xsl:param name="copy"/>
  <xsl:param name="iteration" select="0"/>

  <xsl:template match="/spec:colorSpecification">
    <colorNetJob id="{$job-id}" created="{$created-at}" origin="{$origin}" copy="{$copy}"
                 iteration="{$iteration}">
      <name><xsl:value-of select="spec:name"/></name>
      <xsl:apply-templates select="spec:code"/>
      <finish><xsl:value-of select="spec:finish"/></finish>
      <xsl:apply-templates select="spec:samples"/>
      <xsl:apply-templates select="spec:gloss"/>
      <xsl:apply-templates select="spec:startingPaint"/>
      <xsl:apply-templates select="past:history/past:panel"/>
    </colorNetJob>
  </xsl:template>

  <xsl:template match="spec:code">
    <code><xsl:value-of select="."/></code>
  </xsl:template>

  <xsl:template match="spec:samples">
    <target illumination="{@illumination}" illuminant="{@illuminant}" observer="{@observer}">
      <xsl:for-each select="spec:sample">
        <lab aspecular="{@aspecular}" L="{@L}" a="{@a}" b="{@b}"/>
      </xsl:for-each>
    </target>
  </xsl:template>

  <xsl:template match="spec:gloss">
    <gloss value="{@value}">
      <xsl:if test="@angle">
        <xsl:attribute name="angle"><xsl:value-of select="@angle"/></xsl:attribute>
      </xsl:if>
    </gloss>
  </xsl:template>

  <xsl:template match="spec:startingPaint">
    <startingPaint>
      <code><xsl:value-of select="spec:code"/></code>
      <library><xsl:value-of select="spec:library"/></library>
      <generation><xsl:value-of select="spec:generation"/></generation>
      <differences formula="{spec:formula}" total="{spec:differences/@total}">
        <xsl:for-each select="spec:differences/spec:difference">
          <difference aspecular="{@aspecular}" dE="{@dE}" dL="{@dL}" da="{@da}" db="{@db}"
                      dC="{@dC}" dH="{@dH}"/>
        </xsl:for-each>
      </differences>
    </startingPaint>
  </xsl:template>

  <xsl:template match="past:panel">
    <panel iteration="{@iteration}">
      <formula>
        <xsl:for-each select="past:component">
          <component toner="{@toner}" parts="{@parts}"/>
        </xsl:for-each>
      </formula>
      <predicted><xsl:apply-templates select="past:predicted"/></predicted>
      <measured><xsl:apply-templates select="past:measured"/></measured>
    </panel>
  </xsl:template>

  <xsl:template match="past:predicted | past:measured">
    <lab aspecular="{@aspecular}" L="{@L}" a="{@a}" b="{@b}"/>
  </xsl:template>
</xsl:stylesheet>
