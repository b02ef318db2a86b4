<?xml version="1.0" encoding="UTF-8"?>
<!--
  Table for spreadsheets and statistics: one header row, one row per aspecular angle.

  RFC 4180 with CR LF. Text cells are quoted, and those that a spreadsheet would take
  for a formula get a leading apostrophe; numbers are written as they are, so -12.3
  stays a number. The byte order mark tells Excel that the file is UTF-8.
-->
<xsl:stylesheet version="1.0"
                xmlns:xsl="http://www.w3.org/1999/XSL/Transform"
                xmlns:spec="urn:paintlink:color-specification:1">

  <format xmlns="urn:paintlink:export-format:1"
          id="csv"
          label="Table (CSV)"
          suffix="csv"
          file-name="{date}_{name}"
          starting-paint="optional"/>

  <xsl:output method="text" encoding="UTF-8"/>

  <xsl:param name="job-id"/>
  <xsl:param name="created-at"/>
  <xsl:param name="origin"/>

  <xsl:template match="/spec:colorSpecification">
    <xsl:text>&#xFEFF;job,created,origin,name,code,finish,instrument,serial,measured,</xsl:text>
    <xsl:text>illumination_deg,illuminant,observer_deg,aspecular_deg,L,a,b,</xsl:text>
    <xsl:text>gloss_gu,gloss_angle_deg,starting_paint,formula,dE,dL,da,db,dC,dH&#13;&#10;</xsl:text>
    <xsl:apply-templates select="spec:samples/spec:sample"/>
  </xsl:template>

  <xsl:template match="spec:sample">
    <xsl:variable name="color" select="/spec:colorSpecification"/>
    <xsl:variable name="measurement" select="$color/spec:measurement"/>
    <xsl:variable name="paint" select="$color/spec:startingPaint"/>
    <xsl:variable name="difference"
        select="$paint/spec:differences/spec:difference[@aspecular = current()/@aspecular]"/>

    <xsl:call-template name="text"><xsl:with-param name="of" select="$job-id"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$created-at"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$origin"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$color/spec:name"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$color/spec:code"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$color/spec:finish"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$measurement/spec:instrument/spec:model"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$measurement/spec:instrument/spec:serial"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$measurement/spec:time"/></xsl:call-template>
    <xsl:value-of select="concat(../@illumination, ',')"/>
    <xsl:call-template name="text"><xsl:with-param name="of" select="../@illuminant"/></xsl:call-template>
    <xsl:value-of select="concat(../@observer, ',', @aspecular, ',', @L, ',', @a, ',', @b, ',')"/>
    <xsl:value-of select="concat($color/spec:gloss/@value, ',', $color/spec:gloss/@angle, ',')"/>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$paint/spec:code"/></xsl:call-template>
    <xsl:call-template name="text"><xsl:with-param name="of" select="$paint/spec:formula"/></xsl:call-template>
    <xsl:value-of select="concat($difference/@dE, ',', $difference/@dL, ',', $difference/@da, ',')"/>
    <xsl:value-of select="concat($difference/@db, ',', $difference/@dC, ',', $difference/@dH, '&#13;&#10;')"/>
  </xsl:template>

  <!-- A text cell and the comma after it; nothing between the commas when it is empty. -->
  <xsl:template name="text">
    <xsl:param name="of"/>
    <xsl:variable name="text" select="string($of)"/>
    <xsl:if test="$text != ''">
      <xsl:text>"</xsl:text>
      <xsl:if test="contains('=+-@&#9;&#13;', substring($text, 1, 1))">'</xsl:if>
      <xsl:call-template name="quotes-doubled">
        <xsl:with-param name="text" select="$text"/>
      </xsl:call-template>
      <xsl:text>"</xsl:text>
    </xsl:if>
    <xsl:text>,</xsl:text>
  </xsl:template>

  <xsl:template name="quotes-doubled">
    <xsl:param name="text"/>
    <xsl:choose>
      <xsl:when test="contains($text, '&quot;')">
        <xsl:value-of select="concat(substring-before($text, '&quot;'), '&quot;&quot;')"/>
        <xsl:call-template name="quotes-doubled">
          <xsl:with-param name="text" select="substring-after($text, '&quot;')"/>
        </xsl:call-template>
      </xsl:when>
      <xsl:otherwise>
        <xsl:value-of select="$text"/>
      </xsl:otherwise>
    </xsl:choose>
  </xsl:template>
</xsl:stylesheet>
